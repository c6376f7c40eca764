#include "common/robot_model/robot_calibration.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "common/config/required_keys.h"
#include "common/core/units.h"

namespace kiln {
namespace {

constexpr double kFarthest_m = 0.05, kFarthest_rad = 5.0 * kDeg;

Result<void> near(const char* what, const PoseConfig& found, const PoseConfig& nominal) {
  const Eigen::Isometry3d off = nominal.pose().inverse() * found.pose();
  const double way = off.translation().norm(), turn = rotationAngle(off);
  if (way <= kFarthest_m && turn <= kFarthest_rad) return {};  // NaN is not near either
  return makeError(
      ErrorCode::InvalidInput,
      "{} is {:.0f} mm and {:.1f} deg off its nominal pose; at most 50 mm and 5 deg are "
      "believed: calibrate again",
      what, 1e3 * way, turn / kDeg);
}

}  // namespace

PoseConfig poseConfig(const Eigen::Isometry3d& X) {
  const Eigen::Matrix3d& R = X.linear();
  const double pitch = std::asin(std::clamp(-R(2, 0), -1.0, 1.0));
  // At +-90 deg of pitch roll and yaw are one: all of it is roll.
  const bool upright = std::abs(R(2, 0)) < 1.0 - 1e-12;
  const double yaw = upright ? std::atan2(R(1, 0), R(0, 0)) : 0.0;
  const double roll = upright ? std::atan2(R(2, 1), R(2, 2)) : std::atan2(-R(1, 2), R(1, 1));
  return {{X.translation().x(), X.translation().y(), X.translation().z()},
          {roll / kDeg, pitch / kDeg, yaw / kDeg},
          true};
}

RobotCalibration RobotCalibration::of(const RobotGeometry& nominal) {
  RobotCalibration out;
  out.X_flange_lidar = nominal.X_flange_lidar;
  out.X_flange_thermal = nominal.X_flange_thermal;
  out.X_flange_nozzle = nominal.X_flange_nozzle;
  out.X_base_operatorcamera = nominal.X_base_operatorcamera;
  return out;
}

void RobotCalibration::visit(ConfigArchive& a) {
  a.field("note", note, "when, from what, with which residuals");
  a.section("X_flange_lidar", X_flange_lidar, "LiDAR");
  a.section("X_flange_thermal", X_flange_thermal, "thermal camera");
  a.section("X_flange_nozzle", X_flange_nozzle, "nozzle exit");
  a.section("X_base_operatorcamera", X_base_operatorcamera, "rear-top camera for the operator");
  a.field("lidar_range_bias_m", lidar_range_bias_m, "m", -0.2, 0.2,
          "measured minus true range of each laser, ring 0 first");
}

Result<RobotGeometry> RobotCalibration::applyTo(const RobotGeometry& nominal) const {
  RobotGeometry out = nominal;
  for (const auto& [what, found, target] :
       {std::tuple{"the LiDAR", &X_flange_lidar, &out.X_flange_lidar},
        std::tuple{"the thermal camera", &X_flange_thermal, &out.X_flange_thermal},
        std::tuple{"the nozzle", &X_flange_nozzle, &out.X_flange_nozzle},
        std::tuple{"the operator camera", &X_base_operatorcamera, &out.X_base_operatorcamera}}) {
    if (auto ok = near(what, *found, *target); !ok) return tl::make_unexpected(ok.error());
    *target = *found;
  }
  out.lidar_range_bias_m = lidar_range_bias_m;
  return out;
}

Result<RobotGeometry> loadCalibrated(const std::string& path, const RobotGeometry& nominal) {
  RobotCalibration calibration = RobotCalibration::of(nominal);
  if (auto loaded = loadConfig(path, calibration); !loaded)
    return tl::make_unexpected(loaded.error());
  if (auto complete = requireKeys(
          path, {"X_flange_lidar", "X_flange_thermal", "X_flange_nozzle", "X_base_operatorcamera"});
      !complete)
    return tl::make_unexpected(complete.error());
  auto applied = calibration.applyTo(nominal);
  if (!applied) return makeError(applied.error().code, "{}: {}", path, applied.error().message);
  return applied;
}

}  // namespace kiln
