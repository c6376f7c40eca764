#pragma once

#include <optional>
#include <string>

#include "common/geom/pose.h"

class QPainter;
class QSize;

namespace kiln::gui {

class OrbitCamera;
struct SceneColors;
struct SceneSnapshot;

/// What the operator is about to do, drawn as ghosts.
struct SceneIntent {
  std::optional<Pose2> robot;  ///< where the robot is to be put
  std::string place;           ///< that is to be moved
  Pose2 nudge;                 ///< by this: (dx, dy) in map, yaw about its plate
};

/// Drawn over the picture, in 3D and from above alike: suspected fire places as red rectangles,
/// configured and sensed boxes of a place, the robot's uncertainty, and the intent.
void paintSceneOverlay(QPainter& painter, const SceneSnapshot& snapshot, const SceneIntent& intent,
                       const OrbitCamera& camera, const SceneColors& colors, const QSize& size);

}  // namespace kiln::gui
