#include <vtkActor.h>
#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>
#include <vtkUnsignedCharArray.h>

#include "gui/views/scene3d/scene_actor.h"
#include "gui/views/scene3d/vtk_shapes.h"

namespace kiln::gui {
namespace {

constexpr float kPointSize = 2.0F;

/// The points of the map that the robot localises on: quiet, so that the live scan stands out; the
/// part that is not in use is paler still.
class MapActor final : public SceneActor {
 public:
  explicit MapActor(vtkRenderer& renderer) {
    vtkNew<vtkPolyData> empty;
    points_ = addActor(renderer, empty);
    points_->GetProperty()->SetPointSize(kPointSize);
    points_->GetProperty()->LightingOff();
  }

  void update(const SceneSnapshot& snapshot, const SceneColors& colors) override {
    const LayerState& layer = snapshot.layer(SceneLayer::Map);
    points_->SetVisibility(layer.visible && snapshot.map != nullptr);
    if (!snapshot.map || (revision_ == layer.revision && dark_ == colors.dark)) return;
    revision_ = layer.revision;
    dark_ = colors.dark;
    fill(*snapshot.map, snapshot.submap, colors);
  }

 private:
  void fill(const MapLayer& map, int submap, const SceneColors& colors) {
    const auto n = static_cast<vtkIdType>(map.points_map.size());
    vtkNew<vtkFloatArray> xyz;
    vtkNew<vtkUnsignedCharArray> rgb;
    xyz->SetNumberOfComponents(3);
    rgb->SetNumberOfComponents(3);
    xyz->SetNumberOfTuples(n);
    rgb->SetNumberOfTuples(n);
    for (vtkIdType i = 0; i < n; ++i) {
      const auto k = static_cast<std::size_t>(i);
      const Eigen::Vector3f& p = map.points_map[k];
      const bool in_use = submap < 0 || map.submap_of[k] == submap;
      const Rgb color = in_use ? colors.map_points : colors.map_points_idle;
      xyz->SetTuple3(i, p.x(), p.y(), p.z());
      rgb->SetTuple3(i, color.r, color.g, color.b);
    }
    setMesh(*points_, pointMesh(xyz, rgb));
  }

  std::uint64_t revision_ = ~std::uint64_t{0};
  bool dark_ = true;
  vtkSmartPointer<vtkActor> points_;
};

}  // namespace

std::unique_ptr<SceneActor> makeMapActor(vtkRenderer& renderer) {
  return std::make_unique<MapActor>(renderer);
}

}  // namespace kiln::gui
