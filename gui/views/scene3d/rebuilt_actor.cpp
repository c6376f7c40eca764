#include "gui/views/scene3d/rebuilt_actor.h"

#include <vector>

#include <vtkActor.h>
#include <vtkPolyData.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>

namespace kiln::gui {

struct RebuiltActor::Meshes {
  explicit Meshes(vtkRenderer& r) : renderer(r) {}
  ~Meshes() { clear(); }
  void clear() {
    for (auto& actor : actors) renderer.RemoveActor(actor);
    actors.clear();
  }
  vtkRenderer& renderer;
  std::vector<vtkSmartPointer<vtkActor>> actors;
};

RebuiltActor::RebuiltActor(vtkRenderer& renderer) : meshes_(std::make_unique<Meshes>(renderer)) {}

RebuiltActor::~RebuiltActor() = default;

void RebuiltActor::update(const SceneSnapshot& snapshot, const SceneColors& colors) {
  const std::uint64_t now = revision(snapshot);
  if (revision_ == now && dark_ == colors.dark) return;
  revision_ = now;
  dark_ = colors.dark;
  meshes_->clear();
  build(snapshot, colors);
}

vtkActor& RebuiltActor::add(vtkPolyData* mesh, Rgb color, const Eigen::Isometry3d& X) {
  auto actor = addActor(meshes_->renderer, mesh);
  setColor(*actor, color);
  setPose(*actor, X);
  meshes_->actors.push_back(actor);
  return *actor;
}

}  // namespace kiln::gui
