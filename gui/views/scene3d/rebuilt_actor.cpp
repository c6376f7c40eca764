#include "gui/views/scene3d/rebuilt_actor.h"

#include <vector>

#include <vtkActor.h>
#include <vtkPolyData.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>

namespace kiln::gui {

struct RebuiltActor::Parts {
  std::vector<vtkSmartPointer<vtkActor>> actors;
};

RebuiltActor::RebuiltActor(vtkRenderer& renderer, SceneLayer layer)
    : renderer_(renderer), layer_(layer), parts_(std::make_unique<Parts>()) {}

RebuiltActor::~RebuiltActor() { clear(); }

void RebuiltActor::update(const SceneSnapshot& snapshot, const SceneColors& colors) {
  const LayerState& layer = snapshot.layer(layer_);
  if (revision_ == layer.revision && dark_ == colors.dark) return;
  revision_ = layer.revision;
  dark_ = colors.dark;
  clear();
  if (layer.visible) build(snapshot, layer.freshness, colors);
}

vtkActor* RebuiltActor::add(vtkPolyData* mesh, Rgb color, const Eigen::Isometry3d& X_map_part) {
  auto actor = addActor(renderer_, mesh);
  setColor(*actor, color);
  setPose(*actor, X_map_part);
  parts_->actors.push_back(actor);
  return actor;
}

void RebuiltActor::clear() {
  for (auto& actor : parts_->actors) renderer_.RemoveActor(actor);
  parts_->actors.clear();
}

}  // namespace kiln::gui
