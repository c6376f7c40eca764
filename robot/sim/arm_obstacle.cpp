#include "robot/sim/arm_obstacle.h"

#include "robot/sim/mjcf.h"

namespace kiln::sim {
namespace {

const Eigen::Vector3d kHead_flange(0.0, 0.0, 0.10);  // middle of what the flange carries
constexpr double kHeadRadius_m = 0.20;               // nozzle, LiDAR and gripper about it
constexpr double kGap_m = 0.05;
constexpr double kSlowest_mps = 0.05;  // of the head; slower has no clear direction
constexpr double kLookAhead_s = 5.0, kStep_s = 0.01;

/// Between a point and the surface of an obstacle there.
double clearance(const Eigen::Vector3d& p, const Eigen::Vector3d& center) {
  const Eigen::Vector3d outside = (p - center).cwiseAbs().array() - 0.5 * kObstacleSize_m;
  return outside.cwiseMax(0.0).norm();
}

}  // namespace

/// Joints that go on as they move now: exact while all of them share one time scaling, as in a
/// planned motion.
std::optional<Eigen::Vector3d> ArmObstacle::ahead(const Physics& physics) const {
  const Vector6d q = physics.armPosition(), qd = physics.armVelocity();
  const auto head = [&](double t) -> Eigen::Vector3d {
    return robot_.X_base_flange(q + t * qd) * kHead_flange;
  };
  const Eigen::Isometry3d X_map_base = physics.X_map_base();
  const Eigen::Vector3d p_map = X_map_base * head(0.0);
  if ((head(kStep_s) - head(0.0)).norm() < kSlowest_mps * kStep_s) return std::nullopt;
  for (double t = kStep_s; t < kLookAhead_s; t += kStep_s) {
    const Eigen::Vector3d center = X_map_base * head(t);
    if (clearance(p_map, center) > kHeadRadius_m + kGap_m) return center;
  }
  return std::nullopt;
}

void ArmObstacle::step(bool on, Physics& physics) {
  if (!on && p_map_) {
    physics.removeObstacle();
    p_map_.reset();
  }
  if (!on || p_map_) return;
  const auto wanted = ahead(physics);
  if (wanted && physics.placeObstacle(*wanted)) p_map_ = wanted;
}

}  // namespace kiln::sim
