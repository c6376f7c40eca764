#include "tests/support/heat_sweep.h"

#include <cmath>

namespace kiln::testing {

HeatSweep::HeatSweep(std::uint64_t seed, Config config)
    : config_(config), random_(seed), renderer_({}, seed + 1000) {}

Eigen::Isometry3d HeatSweep::small(double sigma_m, double sigma_deg) {
  std::normal_distribution<> n;
  Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
  for (const auto& axis :
       {Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitY(), Eigen::Vector3d::UnitZ()}) {
    X.rotate(Eigen::AngleAxisd(n(random_) * sigma_deg * M_PI / 180, Eigen::Vector3d(axis)));
  }
  X.translation() = Eigen::Vector3d(n(random_), n(random_), n(random_)) * sigma_m;
  return X;
}

std::optional<SweepError> HeatSweep::run(HeatLocalizer::Config localizer_config) {
  ThermalScene scene;
  const double yaw = uniform(config_.box_yaw_deg) * M_PI / 180;
  scene.X_map_plate.linear() << 0, 0, 1, 1, 0, 0, 0, 1, 0;  // axis along map X
  scene.X_map_plate = Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()) * scene.X_map_plate;
  scene.opening_offset_m = {uniform(config_.off_centre_m), uniform(config_.off_centre_m)};
  const Eigen::Isometry3d X_nominal_true = small(config_.extrinsic_m, config_.extrinsic_deg);
  const Eigen::Vector3d aim(uniform(0.05), uniform(0.10),
                            uniform(0.05));  // where the arm thinks the plate is

  HeatDetector detector({});
  HeatLocalizer localizer(localizer_config);
  localizer.begin();
  Eigen::Isometry3d X_nominal, X_true;
  for (int i = 0; i < config_.views; ++i) {
    const double phase = 2 * M_PI * i / config_.views;
    const double reach = config_.moving ? 1.0 : 0.0;
    const double distance = 0.875 + 0.1 * reach * std::sin(2 * phase);
    const Eigen::Vector3d eye = distance * Eigen::Vector3d(1, 0.15 * reach * std::sin(phase),
                                                           0.08 * reach * std::cos(phase));
    X_nominal =
        lookAt(eye, aim + Eigen::Vector3d(0, 0.08 * std::cos(phase), 0.06 * std::sin(phase)));
    X_true = X_nominal * X_nominal_true * small(config_.pose_m, config_.pose_deg);
    scene.discs.clear();
    if (config_.decoy && i % 3 == 0) scene.discs = {{{0.15, 0.26, 0.12}, 0.06, 400.0}};
    localizer.add(detector.detect(renderer_.render(scene, X_true)), X_nominal,
                  Eigen::Vector3d::UnitX());
  }
  const auto estimate = localizer.estimate();
  if (!estimate) return std::nullopt;
  const Eigen::Vector3d p = scene.X_map_plate.translation();
  const Eigen::Vector3d off = estimate->p_map - p;
  const Eigen::Vector3d ray = (p - X_nominal.translation()).normalized();
  SweepError error;
  error.range_m = std::abs(off.dot(ray));
  error.lateral_m = (off - off.dot(ray) * ray).norm();
  error.baseline_m = std::abs(estimate->baseline_range_m - (p - X_true.translation()).norm());
  error.mahalanobis = std::sqrt(off.dot(estimate->covariance.inverse() * off));
  return error;
}

}  // namespace kiln::testing
