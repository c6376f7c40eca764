#include <cmath>

#include <Eigen/Eigenvalues>
#include <vtkActor.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>

#include "gui/views/scene3d/rebuilt_actor.h"

namespace kiln::gui {
namespace {

using Line = std::vector<Eigen::Vector3d>;
constexpr double kPlateRadius_m = 0.075;
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

Line circle(double radius, const Eigen::Vector3d& center, const Eigen::Vector3d& u,
            const Eigen::Vector3d& v) {
  constexpr int kSteps = 28;
  Line line;
  for (int i = 0; i <= kSteps; ++i) {
    const double a = 2.0 * M_PI * i / kSteps;
    line.push_back(center + radius * (std::cos(a) * u + std::sin(a) * v));
  }
  return line;
}

/// A configured place: the plate's outline, the way it looks and a stem to the ground.
std::vector<Line> placeMark(const FirePlaceInfo& place) {
  const Eigen::Vector3d out(std::cos(place.yaw_rad), std::sin(place.yaw_rad), 0.0);
  const Eigen::Vector3d side(-out.y(), out.x(), 0.0), up = Eigen::Vector3d::UnitZ();
  const Eigen::Vector3d tip = place.p_map + 0.35 * out;
  return {circle(kPlateRadius_m, place.p_map, side, up),
          {place.p_map, tip},
          {tip - 0.08 * out + 0.06 * side, tip, tip - 0.08 * out - 0.06 * side},
          {place.p_map, Eigen::Vector3d(place.p_map.x(), place.p_map.y(), 0.0)}};
}

class PlacesActor final : public SceneActor {
 public:
  explicit PlacesActor(vtkRenderer& renderer) {
    vtkNew<vtkPolyData> empty;
    for (auto* actor : {&open_, &visited_}) {
      *actor = addActor(renderer, empty);
      makeFlat(**actor, 1.0F);
    }
  }

  void update(const SceneSnapshot& snapshot, const SceneColors& colors) override {
    const LayerState& layer = snapshot.layer(SceneLayer::Places);
    for (const auto& actor : {open_, visited_}) actor->SetVisibility(layer.visible);
    setColor(*open_, agedColor(colors.text, layer.freshness, colors));
    setColor(*visited_, agedColor(colors.place, layer.freshness, colors));
    if (revision_ == layer.revision) return;
    revision_ = layer.revision;
    std::vector<Line> open, visited;
    for (const FirePlaceInfo& place : snapshot.places)
      for (Line& line : placeMark(place))
        (place.visited ? visited : open).push_back(std::move(line));
    setMesh(*open_, lineMesh(open));
    setMesh(*visited_, lineMesh(visited));
  }

 private:
  std::uint64_t revision_ = ~std::uint64_t{0};
  vtkSmartPointer<vtkActor> open_, visited_;
};

/// Estimated fires: a core at the estimate and the ellipsoid of two standard deviations.
class FireActor final : public RebuiltActor {
 public:
  explicit FireActor(vtkRenderer& renderer) : RebuiltActor(renderer, SceneLayer::Fire) {}

 protected:
  void build(const SceneSnapshot& snapshot, Freshness freshness,
             const SceneColors& colors) override {
    for (const FireEstimate& fire : snapshot.fires)
      if (fire.p_map.allFinite()) addFire(fire, freshness, colors);
  }

 private:
  void addFire(const FireEstimate& fire, Freshness freshness, const SceneColors& colors) {
    Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
    X.translation() = fire.p_map;
    vtkActor& core = add(sphereMesh(kCoreRadius_m), agedColor(colors.fire, freshness, colors), X);
    core.GetProperty()->SetAmbient(0.6);
    const Ellipsoid e = ellipsoidOf(fire.covariance);
    if (e.half_axes.maxCoeff() <= 0.0) return;
    const Eigen::Vector3d scale = (ellipsoidExaggeration(fire) * e.half_axes).cwiseMax(0.005);
    X.linear() = e.axes * scale.asDiagonal();
    vtkActor& shell =
        add(sphereMesh(1.0), agedColor(colors.fire_uncertainty, freshness, colors), X);
    shell.GetProperty()->SetOpacity(kEllipsoidOpacity);
  }
};

}  // namespace

double ellipsoidExaggeration(const FireEstimate& fire) {
  const double largest = ellipsoidOf(fire.covariance).half_axes.maxCoeff();
  if (largest <= 0.0 || largest >= kSmallestDrawn_m) return 1.0;
  return std::ceil(kSmallestDrawn_m / largest);
}

std::unique_ptr<SceneActor> makePlacesActor(vtkRenderer& renderer) {
  return std::make_unique<PlacesActor>(renderer);
}
std::unique_ptr<SceneActor> makeFireActor(vtkRenderer& renderer) {
  return std::make_unique<FireActor>(renderer);
}

}  // namespace kiln::gui
