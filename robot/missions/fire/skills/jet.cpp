#include "robot/missions/fire/skills/jet.h"

#include <cmath>

namespace kiln {
namespace {
constexpr double kMaxReach_m = 3.0;  // beyond the throw of any jet of this kind
constexpr double kSearchStep_m = 0.01;
}  // namespace

Eigen::Vector3d jetPoint(const SprayCalibration& calibration, const Eigen::Isometry3d& X_map_nozzle,
                         double distance_m, double flow_scale) {
  return X_map_nozzle * Eigen::Vector3d(distance_m, calibration.lateralAt(distance_m), 0.0) -
         Eigen::Vector3d::UnitZ() * calibration.dropAt(distance_m, flow_scale);
}

std::vector<Eigen::Vector3d> jetPoints(const SprayCalibration& calibration,
                                       const Eigen::Isometry3d& X_map_nozzle, double flow_scale,
                                       double length_m, double step_m) {
  std::vector<Eigen::Vector3d> out;
  const int steps = static_cast<int>(std::ceil(length_m / step_m));
  for (int i = 0; i <= steps; ++i) {
    const Eigen::Vector3d p =
        jetPoint(calibration, X_map_nozzle, std::min(length_m, i * step_m), flow_scale);
    if (p.z() < 0.0) break;
    out.push_back(p);
  }
  return out;
}

JetMiss jetMiss(const SprayCalibration& calibration, const Eigen::Isometry3d& X_map_nozzle,
                const Eigen::Vector3d& p_map, const Eigen::Vector3d& normal_map,
                double flow_scale) {
  const auto height = [&](const Eigen::Vector3d& p) { return normal_map.dot(p - p_map); };
  Eigen::Vector3d previous = X_map_nozzle.translation();
  for (double d = kSearchStep_m; d < kMaxReach_m; d += kSearchStep_m) {
    const Eigen::Vector3d next = jetPoint(calibration, X_map_nozzle, d, flow_scale);
    if (height(previous) >= 0.0 && height(next) < 0.0) {
      const Eigen::Vector3d step = next - previous;
      const double s = height(previous) / (height(previous) - height(next));
      const Eigen::Vector3d miss = previous + s * step - p_map;
      const Eigen::Vector3d left = Eigen::Vector3d::UnitZ().cross(-normal_map).normalized();
      return {miss.norm(), left.dot(miss), miss.z(),
              std::acos(std::min(1.0, -normal_map.dot(step.normalized()))), true};
    }
    previous = next;
  }
  return {};
}

}  // namespace kiln
