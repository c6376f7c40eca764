#include <vtkActor.h>
#include <vtkPolyData.h>
#include <vtkProperty.h>
#include <vtkSmartPointer.h>

#include "gui/views/scene3d/rebuilt_actor.h"

namespace kiln::gui {
namespace {

constexpr double kWallOpacity = 0.13;  // the inside stays visible through every wall
constexpr double kFurnitureOpacity = 0.30;
constexpr double kWallHeight_m = 2.2;  // boxes that reach higher are building, lower ones furniture

/// The nominal map: faint solids with their edges.
class ArenaActor final : public RebuiltActor {
 public:
  explicit ArenaActor(vtkRenderer& renderer) : RebuiltActor(renderer, SceneLayer::Walls) {}

 protected:
  void build(const SceneSnapshot& snapshot, Freshness freshness,
             const SceneColors& colors) override {
    for (const SceneBox& box : snapshot.arena) addBox(box, freshness, colors);
  }

 private:
  void addBox(const SceneBox& box, Freshness freshness, const SceneColors& colors) {
    const double top = box.X_map_box.translation().z() + box.half_extent.z();
    const bool wall = top > kWallHeight_m;
    const Rgb color = wall ? colors.wall : colors.furniture;
    vtkActor& solid =
        add(boxMesh(2.0 * box.half_extent), agedColor(color, freshness, colors), box.X_map_box);
    solid.GetProperty()->SetOpacity(wall ? kWallOpacity : kFurnitureOpacity);
    solid.GetProperty()->SetInterpolationToFlat();
    vtkActor& edges = add(boxEdges(-box.half_extent, box.half_extent),
                          agedColor(colors.wall_edge, freshness, colors), box.X_map_box);
    makeFlat(edges, 1.0F);
  }
};

}  // namespace

std::unique_ptr<SceneActor> makeArenaActor(vtkRenderer& renderer) {
  return std::make_unique<ArenaActor>(renderer);
}

}  // namespace kiln::gui
