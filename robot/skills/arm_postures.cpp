#include "robot/skills/arm_postures.h"

#include <algorithm>

#include <fmt/format.h>

#include "robot/planning/arm_motion/ur_inverse.h"

namespace kiln {

std::vector<Vector6d> posturesFor(const RobotGeometry& robot,
                                  const Eigen::Isometry3d& X_base_flange, const Vector6d& from) {
  std::vector<Vector6d> out;
  const Eigen::Isometry3d X = robot.X_base_armbase.pose().inverse() * X_base_flange;
  if (!isFinite(X)) return out;
  for (const Vector6d& q : inverseSolutions(robot.arm, X, from)) {
    out.push_back(nearestTurn(robot.arm, q, from));
  }
  const auto cost = [&](const Vector6d& q) {
    return (q - from).cwiseAbs().cwiseQuotient(robot.arm.velocity_limit).maxCoeff();
  };
  std::stable_sort(out.begin(), out.end(),
                   [&](const Vector6d& a, const Vector6d& b) { return cost(a) < cost(b); });
  return out;
}

bool hasRoom(const ArmCollision& world, const Vector6d& q, double clearance_m, std::string& what) {
  const Clearance room = world.clearance(q);
  if (room.distance_m >= clearance_m) return true;
  if (what.empty()) what = fmt::format("{}, {:.0f} mm", room.what, 1e3 * room.distance_m);
  return false;
}

}  // namespace kiln
