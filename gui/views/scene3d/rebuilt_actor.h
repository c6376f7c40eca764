#pragma once

#include <cstdint>
#include <vector>

#include <vtkActor.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>

#include "gui/views/scene3d/scene_actor.h"
#include "gui/views/scene3d/vtk_shapes.h"

namespace kiln::gui {

/// A layer of few meshes that change seldom: all of them are made anew when the layer or the theme
/// has changed. Include in .cpp files only (VTK).
class RebuiltActor : public SceneActor {
 public:
  RebuiltActor(vtkRenderer& renderer, SceneLayer layer) : renderer_(renderer), layer_(layer) {}
  ~RebuiltActor() override { clear(); }

  void update(const SceneSnapshot& snapshot, const SceneColors& colors) final {
    const LayerState& layer = snapshot.layer(layer_);
    if (revision_ == layer.revision && dark_ == colors.dark) return;
    revision_ = layer.revision;
    dark_ = colors.dark;
    clear();
    if (layer.visible) build(snapshot, layer.freshness, colors);
  }

 protected:
  virtual void build(const SceneSnapshot& snapshot, Freshness freshness,
                     const SceneColors& colors) = 0;
  vtkSmartPointer<vtkActor> add(vtkPolyData* mesh, Rgb color, const Eigen::Isometry3d& X) {
    auto actor = addActor(renderer_, mesh);
    setColor(*actor, color);
    setPose(*actor, X);
    actors_.push_back(actor);
    return actor;
  }

 private:
  void clear() {
    for (auto& actor : actors_) renderer_.RemoveActor(actor);
    actors_.clear();
  }

  vtkRenderer& renderer_;
  const SceneLayer layer_;
  std::uint64_t revision_ = ~std::uint64_t{0};
  bool dark_ = true;
  std::vector<vtkSmartPointer<vtkActor>> actors_;
};

}  // namespace kiln::gui
