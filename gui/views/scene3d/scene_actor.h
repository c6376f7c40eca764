#pragma once

#include <memory>

#include "gui/views/scene3d/robot_shape.h"
#include "gui/views/scene3d/scene_colors.h"
#include "gui/views/scene3d/scene_state.h"

class vtkRenderer;

namespace kiln::gui {

/// One layer of the 3D scene: owns its meshes in a renderer and follows the snapshots. Confined to
/// the render thread.
class SceneActor {
 public:
  virtual ~SceneActor() = default;
  /// Takes over what changed since the last call (layer revisions) and the layer's visibility and
  /// freshness.
  virtual void update(const SceneSnapshot& snapshot, const SceneColors& colors) = 0;
};

[[nodiscard]] std::unique_ptr<SceneActor> makeGridActor(vtkRenderer& renderer);
[[nodiscard]] std::unique_ptr<SceneActor> makeRobotActor(vtkRenderer& renderer,
                                                         const RobotShape& shape);
/// @param budget  points drawn at most; denser clouds are thinned evenly.
[[nodiscard]] std::unique_ptr<SceneActor> makeCloudActor(vtkRenderer& renderer, std::size_t budget);
[[nodiscard]] std::unique_ptr<SceneActor> makeMapActor(vtkRenderer& renderer);
[[nodiscard]] std::unique_ptr<SceneActor> makeArenaActor(vtkRenderer& renderer);
[[nodiscard]] std::unique_ptr<SceneActor> makePlannedPathActor(vtkRenderer& renderer);
[[nodiscard]] std::unique_ptr<SceneActor> makeDrivenPathActor(vtkRenderer& renderer);
[[nodiscard]] std::unique_ptr<SceneActor> makeEstimateActor(vtkRenderer& renderer);

/// The colour of a layer at its age: full, pale from 1.5 s, grey from 3 s.
[[nodiscard]] Rgb agedColor(Rgb color, Freshness freshness, const SceneColors& colors);

/// Factor by which the uncertainty is drawn larger so that it can be seen; 1 = true size. Labelled
/// in the view.
[[nodiscard]] double ellipsoidExaggeration(const Eigen::Matrix3d& covariance);

}  // namespace kiln::gui
