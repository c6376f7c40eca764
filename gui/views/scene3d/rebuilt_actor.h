#pragma once

#include <cstdint>
#include <memory>

#include "gui/views/scene3d/scene_actor.h"
#include "gui/views/scene3d/vtk_shapes.h"

namespace kiln::gui {

/// A layer of few meshes that change seldom: all of them are made anew when the layer or the theme
/// has changed.
class RebuiltActor : public SceneActor {
 public:
  explicit RebuiltActor(vtkRenderer& renderer);
  ~RebuiltActor() override;  ///< takes its meshes out of the renderer
  void update(const SceneSnapshot& snapshot, const SceneColors& colors) final;

 protected:
  /// Counts changes of what build() draws.
  [[nodiscard]] virtual std::uint64_t revision(const SceneSnapshot& snapshot) const = 0;
  virtual void build(const SceneSnapshot& snapshot, const SceneColors& colors) = 0;
  /// Into the renderer, until the next build.
  vtkActor& add(vtkPolyData* mesh, Rgb color, const Eigen::Isometry3d& X);

 private:
  struct Meshes;
  std::unique_ptr<Meshes> meshes_;
  std::uint64_t revision_ = ~std::uint64_t{0};
  bool dark_ = true;
};

}  // namespace kiln::gui
