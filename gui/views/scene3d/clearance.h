#pragma once

#include <optional>

#include "gui/views/scene3d/scene_state.h"

namespace kiln::gui {

/// What stands nearest to the robot, in the newest cloud.
struct Clearance {
  double distance_m = 0.0;   ///< from the edge of the footprint, along the ground
  double bearing_rad = 0.0;  ///< in base: 0 ahead, positive to the left
};

/// Points lower than a kerb or higher than the robot are passed over, as is what lies within the
/// footprint (the robot itself). One point alone is noise: the distance is that of the third
/// nearest. On a slope the ground ahead may be taken for an obstacle from about 2 m on.
/// @return nullopt without a robot, a cloud, or anything to measure.
[[nodiscard]] std::optional<Clearance> nearestObstacle(const SceneSnapshot& snapshot,
                                                       const RobotGeometry& geometry);

/// "ahead", "ahead left", ... "behind right".
[[nodiscard]] const char* sideWord(double bearing_rad);

}  // namespace kiln::gui
