#include <vtkActor.h>
#include <vtkPolyData.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>

#include "gui/views/scene3d/scene_actor.h"
#include "gui/views/scene3d/vtk_shapes.h"

namespace kiln::gui {
namespace {

constexpr double kWallOpacity = 0.13;  // the inside stays visible through every wall
constexpr double kFurnitureOpacity = 0.30;
constexpr double kWallHeight_m = 2.2;  // boxes that reach higher are building, lower ones furniture

/// The nominal map: faint solids with their edges.
class ArenaActor final : public SceneActor {
 public:
  explicit ArenaActor(vtkRenderer& renderer) : renderer_(renderer) {}
  ~ArenaActor() override { clear(); }

  void update(const SceneSnapshot& snapshot, const SceneColors& colors) override {
    const LayerState& layer = snapshot.layer(SceneLayer::Walls);
    if (revision_ == layer.revision && dark_ == colors.dark) return;
    revision_ = layer.revision;
    dark_ = colors.dark;
    clear();
    if (!layer.visible) return;
    for (const SceneBox& box : snapshot.arena) add(box, layer.freshness, colors);
  }

 private:
  void add(const SceneBox& box, Freshness freshness, const SceneColors& colors) {
    const double top = box.X_map_box.translation().z() + box.half_extent.z();
    const bool wall = top > kWallHeight_m;
    auto solid = addActor(renderer_, boxMesh(2.0 * box.half_extent));
    setColor(*solid, agedColor(wall ? colors.wall : colors.furniture, freshness, colors));
    solid->GetProperty()->SetOpacity(wall ? kWallOpacity : kFurnitureOpacity);
    solid->GetProperty()->SetInterpolationToFlat();
    setPose(*solid, box.X_map_box);
    auto edges = addActor(renderer_, boxEdges(-box.half_extent, box.half_extent));
    makeFlat(*edges, 1.0F);
    setColor(*edges, agedColor(colors.wall_edge, freshness, colors));
    setPose(*edges, box.X_map_box);
    actors_.push_back(solid);
    actors_.push_back(edges);
  }

  void clear() {
    for (auto& actor : actors_) renderer_.RemoveActor(actor);
    actors_.clear();
  }

  vtkRenderer& renderer_;
  std::uint64_t revision_ = ~std::uint64_t{0};
  bool dark_ = true;
  std::vector<vtkSmartPointer<vtkActor>> actors_;
};

}  // namespace

std::unique_ptr<SceneActor> makeArenaActor(vtkRenderer& renderer) {
  return std::make_unique<ArenaActor>(renderer);
}

}  // namespace kiln::gui
