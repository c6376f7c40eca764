#include <cmath>
#include <optional>

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
constexpr double kLowest_m = -0.1, kHighest_m = 2.6;  // the colour range: floor to above the door

/// The newest LiDAR sweep, coloured by height over the ground.
class CloudActor final : public SceneActor {
 public:
  CloudActor(vtkRenderer& renderer, std::size_t budget) : budget_(budget) {
    vtkNew<vtkPolyData> empty;
    points_ = addActor(renderer, empty);
    points_->GetProperty()->SetPointSize(kPointSize);
    points_->GetProperty()->LightingOff();
    outline_ = addActor(renderer, empty);
    makeFlat(*outline_, 1.0F);
  }

  void update(const SceneSnapshot& snapshot, const SceneColors& colors) override {
    const LayerState& layer = snapshot.layer(SceneLayer::Lidar);
    const bool shown = layer.visible && snapshot.cloud != nullptr;
    points_->SetVisibility(shown);
    outline_->SetVisibility(shown && layer.freshness == Freshness::Stale);
    if (!shown || (revision_ == layer.revision && dark_ == colors.dark)) return;
    revision_ = layer.revision;
    dark_ = colors.dark;
    fill(*snapshot.cloud, snapshot.X_map_cloud, layer.freshness, colors);
    setColor(*outline_, colors.caution);
  }

 private:
  void fill(const PointCloud& cloud, const Eigen::Isometry3d& X_map_cloud, Freshness freshness,
            const SceneColors& colors) {
    std::array<Rgb, 256> palette = PerceptualMap::height(colors.dark).table();
    for (Rgb& color : palette) color = agedColor(color, freshness, colors);
    const std::size_t stride = std::max<std::size_t>(1, (cloud.size() + budget_ - 1) / budget_);
    vtkNew<vtkFloatArray> xyz;
    vtkNew<vtkUnsignedCharArray> rgb;
    xyz->SetNumberOfComponents(3);
    rgb->SetNumberOfComponents(3);
    const auto capacity = static_cast<vtkIdType>(3 * (cloud.size() / stride + 1));
    float* p_out = xyz->WritePointer(0, capacity);
    unsigned char* c_out = rgb->WritePointer(0, capacity);
    const Eigen::Matrix3f R = X_map_cloud.linear().cast<float>();
    const Eigen::Vector3f t = X_map_cloud.translation().cast<float>();
    Eigen::AlignedBox3d bounds;
    vtkIdType n = 0;
    for (std::size_t i = 0; i < cloud.size(); i += stride) {
      const Eigen::Vector3f p = R * Eigen::Vector3f(cloud.x[i], cloud.y[i], cloud.z[i]) + t;
      if (!p.allFinite()) continue;
      const double level = (p.z() - kLowest_m) / (kHighest_m - kLowest_m);
      const Rgb& color = palette[static_cast<std::size_t>(255.0 * std::clamp(level, 0.0, 1.0))];
      for (int k = 0; k < 3; ++k) *p_out++ = p[k];
      for (const unsigned char v : {color.r, color.g, color.b}) *c_out++ = v;
      bounds.extend(p.cast<double>());
      ++n;
    }
    xyz->SetNumberOfTuples(n);
    rgb->SetNumberOfTuples(n);
    setMesh(*points_, pointMesh(xyz, rgb));
    if (n > 0) setMesh(*outline_, boxEdges(bounds.min(), bounds.max()));
  }

  std::size_t budget_;
  std::uint64_t revision_ = ~std::uint64_t{0};
  bool dark_ = true;
  vtkSmartPointer<vtkActor> points_, outline_;
};

}  // namespace

std::unique_ptr<SceneActor> makeCloudActor(vtkRenderer& renderer, std::size_t budget) {
  return std::make_unique<CloudActor>(renderer, std::max<std::size_t>(1, budget));
}

}  // namespace kiln::gui
