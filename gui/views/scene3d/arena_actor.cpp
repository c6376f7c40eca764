#include <vtkActor.h>
#include <vtkPolyData.h>
#include <vtkProperty.h>
#include <vtkSmartPointer.h>

#include "gui/views/scene3d/rebuilt_actor.h"

namespace kiln::gui {
namespace {

// Only the faces towards the camera are drawn; the inside stays visible through every wall.
constexpr double kWallOpacity = 0.24;
constexpr double kFurnitureOpacity = 0.50;
constexpr double kWallHeight_m = 2.2;  // boxes that reach higher are building, lower ones furniture

/// The nominal map: faint solids with their edges. Large and translucent, they are what a software
/// renderer spends its time on: three meshes in all, no lamp, no hidden faces.
class ArenaActor final : public RebuiltActor {
 public:
  explicit ArenaActor(vtkRenderer& renderer) : RebuiltActor(renderer) {}

 protected:
  [[nodiscard]] std::uint64_t revision(const SceneSnapshot& snapshot) const override {
    return snapshot.layer(SceneLayer::Walls).revision;
  }
  void build(const SceneSnapshot& snapshot, const SceneColors& colors) override {
    if (!snapshot.layer(SceneLayer::Walls).visible) return;
    const Freshness freshness = snapshot.layer(SceneLayer::Walls).freshness;
    std::vector<PlacedBox> walls, furniture, all;
    for (const SceneBox& box : snapshot.arena) {
      const double top = box.X_map_box.translation().z() + box.half_extent.z();
      all.push_back({box.X_map_box, box.half_extent});
      (top > kWallHeight_m ? walls : furniture).push_back(all.back());
    }
    addSolids(walls, agedColor(colors.wall, freshness, colors), kWallOpacity);
    addSolids(furniture, agedColor(colors.furniture, freshness, colors), kFurnitureOpacity);
    vtkActor& edges = add(edgesOf(all), agedColor(colors.wall_edge, freshness, colors),
                          Eigen::Isometry3d::Identity());
    makeFlat(edges, 1.0F);
  }

 private:
  void addSolids(const std::vector<PlacedBox>& boxes, Rgb color, double opacity) {
    vtkActor& solid = add(shadedBoxes(boxes, color), color, Eigen::Isometry3d::Identity());
    solid.GetProperty()->LightingOff();  // the shades are in the mesh
    solid.GetProperty()->BackfaceCullingOn();
    solid.GetProperty()->SetOpacity(opacity);
  }
};

}  // namespace

std::unique_ptr<SceneActor> makeArenaActor(vtkRenderer& renderer) {
  return std::make_unique<ArenaActor>(renderer);
}

}  // namespace kiln::gui
