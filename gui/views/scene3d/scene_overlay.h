#pragma once

#include <optional>
#include <vector>

#include "common/model/scene.h"

class QPainter;
class QSize;

namespace kiln::gui {

class OrbitCamera;
struct SceneColors;
struct SceneSnapshot;

/// What the operator is about to do, drawn as ghosts.
struct SceneIntent {
  std::optional<Pose2> robot;    ///< where the robot is to be put
  std::vector<SceneItem> items;  ///< where things of the mission are to be put
};

/// Drawn over the picture, in 3D and from above alike, and so seen through everything: lines and
/// boxes of the mission, the robot's uncertainty, and the intent.
void paintSceneOverlay(QPainter& painter, const SceneSnapshot& snapshot, const SceneIntent& intent,
                       const OrbitCamera& camera, const SceneColors& colors, const QSize& size);

}  // namespace kiln::gui
