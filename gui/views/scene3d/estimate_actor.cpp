#include <cmath>

#include <Eigen/Eigenvalues>
#include <vtkActor.h>
#include <vtkPolyData.h>
#include <vtkProperty.h>
#include <vtkSmartPointer.h>

#include "gui/views/scene3d/rebuilt_actor.h"

namespace kiln::gui {
namespace {

constexpr double kCoreRadius_m = 0.03;
constexpr double kSigmas = 2.0;
constexpr double kSmallestDrawn_m = 0.08;  // the largest half axis is drawn at least this long
constexpr double kEllipsoidOpacity = 0.35;

struct Ellipsoid {
  Eigen::Vector3d half_axes;  // metres, at kSigmas
  Eigen::Matrix3d axes;
};

/// nullopt-like: half axes 0 for a covariance that is not finite.
Ellipsoid ellipsoidOf(const Eigen::Matrix3d& covariance) {
  if (!covariance.allFinite()) return {Eigen::Vector3d::Zero(), Eigen::Matrix3d::Identity()};
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(
      0.5 * (covariance + covariance.transpose()));
  Eigen::Matrix3d axes = solver.eigenvectors();
  if (axes.determinant() < 0) axes.col(0) *= -1.0;
  return {kSigmas * solver.eigenvalues().cwiseMax(0.0).cwiseSqrt(), axes};
}

/// What the mission has estimated: a core at the estimate and the ellipsoid of two standard
/// deviations.
class EstimateActor final : public RebuiltActor {
 public:
  explicit EstimateActor(vtkRenderer& renderer) : RebuiltActor(renderer) {}

 protected:
  [[nodiscard]] std::uint64_t revision(const SceneSnapshot& snapshot) const override {
    return snapshot.items_revision;
  }
  void build(const SceneSnapshot& snapshot, const SceneColors& colors) override {
    for (const SceneItem& item : snapshot.items) {
      const LayerState& layer = snapshot.layer(item.layer);
      if (item.shape == SceneItem::Shape::Estimate && layer.visible)
        addEstimate(item, layer.freshness, colors);
    }
  }

 private:
  void addEstimate(const SceneItem& item, Freshness freshness, const SceneColors& colors) {
    Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
    X.translation() = item.X_map_item.translation();
    vtkActor& core =
        add(sphereMesh(kCoreRadius_m), agedColor(colors.item(item.style), freshness, colors), X);
    core.GetProperty()->SetAmbient(0.6);
    const Ellipsoid e = ellipsoidOf(item.covariance);
    if (e.half_axes.maxCoeff() <= 0.0) return;
    const Eigen::Vector3d scale =
        (ellipsoidExaggeration(item.covariance) * e.half_axes).cwiseMax(0.005);
    X.linear() = e.axes * scale.asDiagonal();
    vtkActor& shell = add(sphereMesh(1.0), agedColor(colors.uncertainty, freshness, colors), X);
    shell.GetProperty()->SetOpacity(kEllipsoidOpacity);
  }
};

}  // namespace

double ellipsoidExaggeration(const Eigen::Matrix3d& covariance) {
  const double largest = ellipsoidOf(covariance).half_axes.maxCoeff();
  if (largest <= 0.0 || largest >= kSmallestDrawn_m) return 1.0;
  return std::ceil(kSmallestDrawn_m / largest);
}

std::unique_ptr<SceneActor> makeEstimateActor(vtkRenderer& renderer) {
  return std::make_unique<EstimateActor>(renderer);
}

}  // namespace kiln::gui
