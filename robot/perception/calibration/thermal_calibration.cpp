#include "robot/perception/calibration/thermal_calibration.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <ceres/ceres.h>

#include "common/core/units.h"
#include "robot/perception/calibration/mounting.h"

namespace kiln {
namespace {

/// What the sightings are held against.
struct Scene {
  thermal::PlateModel plate;
  CameraModel camera;
  Eigen::Isometry3d X_flange_thermal;
  Eigen::Vector3d p_base_plate, normal_base;

  /// Expected image of the plate's visible part.
  [[nodiscard]] std::optional<Eigen::Vector2d> image(const PlateSighting& seen, const double* mount,
                                                     const double* where) const {
    const Eigen::Vector3d p = p_base_plate + Eigen::Vector3d(where[0], where[1], where[2]);
    const Eigen::Vector3d normal =
        Eigen::AngleAxisd(where[3], Eigen::Vector3d::UnitZ()) * normal_base;
    const Eigen::Isometry3d X_camera_plate =
        (seen.X_base_flange * X_flange_thermal * mountingError(mount)).inverse() *
        thermal::platePose(p, normal);
    const auto view = thermal::viewPlate(plate, camera, X_camera_plate);
    return view ? std::optional(view->centre_px) : std::nullopt;
  }
};

struct Reprojection {
  const Scene& scene;
  const PlateSighting& seen;
  double sigma_px;
  bool operator()(const double* mount, const double* where, double* residual) const {
    const auto expected = scene.image(seen, mount, where);
    if (!expected) return false;
    residual[0] = (expected->x() - seen.centre_px.x()) / sigma_px;
    residual[1] = (expected->y() - seen.centre_px.y()) / sigma_px;
    return true;
  }
};

double rmsOf(const Scene& scene, std::span<const PlateSighting> sightings, const double* mount,
             const double* where) {
  double sum = 0.0, count = 0.0;
  for (const PlateSighting& seen : sightings) {
    const auto expected = scene.image(seen, mount, where);
    if (!expected) continue;
    sum += (*expected - seen.centre_px).squaredNorm();
    count += 2.0;
  }
  return count > 0.0 ? std::sqrt(sum / count) : 0.0;
}

std::vector<Eigen::Isometry3d> flangePoses(std::span<const PlateSighting> sightings) {
  std::vector<Eigen::Isometry3d> out;
  for (const PlateSighting& seen : sightings) out.push_back(seen.X_base_flange);
  return out;
}

}  // namespace

void ThermalCalibrator::Config::visit(ConfigArchive& a) {
  a.field("hfov_deg", hfov_deg, "deg", 10, 150, "horizontal field of view");
  a.field("noise_px", noise_px, "px", 0.01, 5, "one sigma of a blob's centre");
  a.field("prior_m", prior_m, "m", 0.001, 1, "prior of the mounting");
  a.field("prior_deg", prior_deg, "deg", 0.1, 45, "prior of the mounting");
  a.field("plate_prior_m", plate_prior_m, "m", 0.001, 5, "prior of where the plate is");
  a.field("yaw_prior_deg", yaw_prior_deg, "deg", 0.1, 90, "prior of where it looks");
  a.field("min_sightings", min_sightings, "", 4, 1000, "fewer are refused");
}

Result<ThermalCalibration> ThermalCalibrator::calibrate(std::span<const PlateSighting> sightings,
                                                        const Eigen::Isometry3d& X_flange_thermal,
                                                        const Eigen::Vector3d& p_base_plate,
                                                        const Eigen::Vector3d& normal_base) const {
  constexpr double kLeastTurn = 5.0 * kDeg;
  if (sightings.size() < static_cast<std::size_t>(config_.min_sightings))
    return makeError(
        ErrorCode::Degenerate,
        "the hot plate was seen from {} postures; {} are needed, and a plate that is hot",
        sightings.size(), config_.min_sightings);
  if (secondTurn(flangePoses(sightings)) < kLeastTurn)
    return makeError(ErrorCode::Degenerate,
                     "the flange was turned about one axis only; the thermal camera's mounting "
                     "needs two");
  const Scene scene{config_.plate,
                    CameraModel::fromHorizontalFov(160, 120, config_.hfov_deg * kDeg),
                    X_flange_thermal, p_base_plate, normal_base};
  std::array<double, 6> mount{};
  std::array<double, 4> where{};
  ceres::Problem problem;
  for (const PlateSighting& seen : sightings) {
    problem.AddResidualBlock(
        new ceres::NumericDiffCostFunction<Reprojection, ceres::CENTRAL, 2, 6, 4>(
            new Reprojection{scene, seen, config_.noise_px}),
        new ceres::CauchyLoss(3.0), mount.data(), where.data());
  }
  const double t = config_.prior_m, r = config_.prior_deg * kDeg, w = config_.plate_prior_m;
  problem.AddResidualBlock(
      new ceres::AutoDiffCostFunction<Prior<6>, 6, 6>(new Prior<6>{{r, r, r, t, t, t}}), nullptr,
      mount.data());
  problem.AddResidualBlock(new ceres::AutoDiffCostFunction<Prior<4>, 4, 4>(
                               new Prior<4>{{w, w, w, config_.yaw_prior_deg * kDeg}}),
                           nullptr, where.data());
  // The residuals before: the best plate for the nominal mounting.
  problem.SetParameterBlockConstant(mount.data());
  (void)solveMounting(problem, "thermal camera");  // the second one tells
  ThermalCalibration out;
  out.flange_thermal.rms_before = rmsOf(scene, sightings, mount.data(), where.data());
  problem.SetParameterBlockVariable(mount.data());
  if (auto solved = solveMounting(problem, "thermal camera"); !solved)
    return tl::make_unexpected(solved.error());
  out.flange_thermal.X_parent_sensor = X_flange_thermal * mountingError(mount.data());
  out.flange_thermal.rms_after = rmsOf(scene, sightings, mount.data(), where.data());
  out.flange_thermal.unit = "px";
  out.flange_thermal.views = out.flange_thermal.measurements = static_cast<int>(sightings.size());
  out.p_base_plate = p_base_plate + Eigen::Vector3d(where[0], where[1], where[2]);
  takeSigmas(problem, mount.data(), out.flange_thermal);
  return out;
}

}  // namespace kiln
