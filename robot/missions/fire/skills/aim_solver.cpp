#include "robot/missions/fire/skills/aim_solver.h"

#include <algorithm>
#include <cmath>

#include "common/core/units.h"

namespace kiln {
namespace {
constexpr int kAimIterations =
    4;  // the drop hardly changes with the correction: converges to under 0.1 mm in 2

/// A standoff 5 cm off is as bad as 10 deg aside or half a height factor.
double departure(const AimVariation& v, const AimSolverConfig& config) {
  return std::abs(v.standoff_m - config.standoff_m) / 0.05 +
         std::abs(v.lateral_rad) / (10.0 * kDeg) + std::abs(1.0 - v.height_factor) / 0.5;
}

}  // namespace

void AimSolverConfig::visit(ConfigArchive& a) {
  a.field("standoff_m", standoff_m, "m", 0.3, 1.3,
          "preferred distance of the nozzle from the plate");
  a.field("min_standoff_m", min_standoff_m, "m", 0.2, 1.3, "nearest variation");
  a.field("max_standoff_m", max_standoff_m, "m", 0.3, 1.5, "farthest variation");
  a.field("standoff_step_m", standoff_step_m, "m", 0.01, 0.5, "between variations");
  a.field("max_lateral_deg", max_lateral_deg, "deg", 0.0, 40.0,
          "largest angle off the opening's normal");
  a.field("lateral_step_deg", lateral_step_deg, "deg", 1.0, 40.0, "between variations");
}

Eigen::Isometry3d aimNozzle(const AimTarget& target, const AimVariation& variation,
                            const SprayCalibration& calibration, double flow_scale) {
  const Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
  const Eigen::Vector3d p_opening = target.p_opening_map();
  const double level_distance = variation.standoff_m - target.recess_m;
  const Eigen::Vector3d back = Eigen::AngleAxisd(variation.lateral_rad, up) * target.normal_map;
  Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
  X.translation() = p_opening + level_distance * back -
                    variation.height_factor * calibration.dropAt(level_distance, flow_scale) * up;
  // Point above the opening by the drop that the jet has by then, and against its lateral offset.
  Eigen::Vector3d aim_point = p_opening;
  for (int i = 0; i < kAimIterations; ++i) {
    const Eigen::Vector3d line = aim_point - X.translation();
    const double distance = line.norm();
    X.linear() = frameFromXAndUp(line, up);
    aim_point = p_opening + calibration.dropAt(distance, flow_scale) * up -
                calibration.lateralAt(distance) * X.linear().col(1);
  }
  X.linear() = frameFromXAndUp(aim_point - X.translation(), up);
  return X;
}

std::vector<AimVariation> aimVariations(const AimSolverConfig& config) {
  std::vector<AimVariation> out;
  for (double standoff = config.min_standoff_m; standoff <= config.max_standoff_m + 1e-9;
       standoff += config.standoff_step_m)
    for (double lateral = 0.0; lateral <= config.max_lateral_deg + 1e-9;
         lateral += config.lateral_step_deg)
      for (const double height : {1.0, 0.0}) {
        out.push_back({standoff, lateral * kDeg, height});
        if (lateral > 0.0) out.push_back({standoff, -lateral * kDeg, height});
      }
  std::stable_sort(out.begin(), out.end(), [&config](const AimVariation& a, const AimVariation& b) {
    return departure(a, config) < departure(b, config) - 1e-9;
  });
  return out;
}

Result<AimSolution> solveAim(
    const AimTarget& target, const AimSolverConfig& config, const SprayCalibration& calibration,
    double flow_scale, const std::function<Result<void>(const Eigen::Isometry3d&)>& feasible) {
  std::string first_reason;
  for (const AimVariation& variation : aimVariations(config)) {
    const Eigen::Isometry3d X_map_nozzle = aimNozzle(target, variation, calibration, flow_scale);
    const Result<void> verdict = feasible(X_map_nozzle);
    if (verdict) return AimSolution{variation, X_map_nozzle};
    if (first_reason.empty()) first_reason = verdict.error().message;
  }
  return makeError(ErrorCode::Refused, "no spray pose before the heat source can be reached: {}",
                   first_reason);
}

}  // namespace kiln
