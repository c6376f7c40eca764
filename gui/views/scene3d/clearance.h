#pragma once

#include <optional>
#include <vector>

#include "gui/views/scene3d/scene_state.h"

namespace kiln::gui {

/// What stands nearest to the robot, in the newest cloud.
struct Clearance {
  double distance_m = 0.0;   ///< from the edge of the footprint, along the ground; 0: it touches
  double bearing_rad = 0.0;  ///< in base: 0 ahead, positive to the left
};

/// Measures it, and does not lose what has come so near that the LiDAR cannot tell it from the
/// robot itself: the robot takes its own body out of a scan with a margin of 6 cm. What stood within
/// 10 cm is remembered where it stood, in map, for 20 s (as the robot remembers what is too low to
/// be seen), until the robot has gone from it so far that it would be seen.
class ClearanceMeter {
 public:
  /// To be asked once for each new cloud. Points lower than a kerb or higher than the robot are
  /// passed over, as is what lies more than 10 cm within the footprint (what is left of the robot's
  /// own). Less deep it touches: between scan and picture a robot moves by so much. One point alone
  /// is noise: the distance is that of the third nearest. On a slope the ground ahead may be taken
  /// for an obstacle from about 2 m on.
  /// @return nullopt without a robot, a cloud, or anything to measure.
  [[nodiscard]] std::optional<Clearance> look(const SceneSnapshot& snapshot,
                                              const RobotGeometry& geometry);

 private:
  /// Points that stood within a few centimetres of each other.
  struct Spot {
    Eigen::Vector2d at_map;
    int points = 0;  ///< of the cloud that saw it last
    Stamp seen;
  };
  void remember(const Eigen::Vector2d& at_map, Stamp now);
  std::vector<Spot> near_;
};

/// "ahead", "ahead left", ... "behind right".
[[nodiscard]] const char* sideWord(double bearing_rad);

}  // namespace kiln::gui
