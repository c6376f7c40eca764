#include "robot/planning/view_poses/lidar_view.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "common/core/check.h"
#include "common/core/units.h"
#include "robot/planning/arm_motion/ur_inverse.h"

namespace kiln {
namespace {

constexpr double kTiltStep_rad = 4.0 * kDeg;
constexpr double kLimitMargin_rad = 3.0 * kDeg;  // the controller's soft limits are 2 deg inside
constexpr double kRampShare = 0.85;              // of the duration, as if at constant speed

/// The posture on the branch of `q` that holds the LiDAR at another tilt, step by step.
std::optional<Vector6d> follow(const RobotGeometry& robot, const Eigen::Isometry3d& X_lidar_flange,
                               const LidarView& view, double to_rad, Vector6d q,
                               double max_step_rad) {
  const Eigen::Isometry3d X_armbase_base = robot.X_base_armbase.pose().inverse();
  const int steps =
      std::max(1, static_cast<int>(std::ceil(std::abs(to_rad - view.middle()) / kTiltStep_rad)));
  for (int k = 1; k <= steps; ++k) {
    const double tilt = view.middle() + (to_rad - view.middle()) * k / steps;
    const Eigen::Isometry3d X = X_armbase_base * view.X_base_lidar(tilt) * X_lidar_flange;
    std::optional<Vector6d> next;
    double step = max_step_rad;
    for (const Vector6d& solution : inverseSolutions(robot.arm, X, q)) {
      const Vector6d near = nearestTurn(robot.arm, solution, q);
      const double turn = (near - q).cwiseAbs().maxCoeff();
      if (turn <= step) {
        step = turn;
        next = near;
      }
    }
    if (!next) return std::nullopt;
    q = *next;
  }
  return q;
}

/// Empty: the arm may sweep so.
std::string whatHinders(const RobotGeometry& robot, const ArmCollision& world,
                        const SweepMotion& motion, const SweepMotionLimits& limits) {
  if (!withinLimits(robot.arm, motion.q_from, kLimitMargin_rad) ||
      !withinLimits(robot.arm, motion.q_to, kLimitMargin_rad))
    return "a joint would pass its limit";
  const Vector6d speed =
      (motion.q_to - motion.q_from).cwiseAbs() / (kRampShare * motion.duration_s);
  if (((speed - limits.speed_scale * robot.arm.velocity_limit).array() > 0.0).any())
    return "the arm would have to turn too fast";
  for (const Vector6d& q : {motion.q_from, motion.q_to}) {
    const Clearance room = world.clearance(q);
    if (room.distance_m < limits.clearance_m)
      return fmt::format("too near: {}, {:.0f} mm", room.what, 1e3 * room.distance_m);
  }
  if (!world.pathIsFree(motion.q_from, motion.q_to, limits.clearance_m))
    return "too near to something on the way";
  return {};
}

}  // namespace

Eigen::Isometry3d LidarView::X_base_lidar(double tilt_rad) const {
  return makePose(p_base, {0.0, tilt_rad, yaw_rad});
}

Result<SweepMotion> sweepMotion(const RobotGeometry& robot, const ArmCollision& world,
                                const LidarView& view, const Vector6d& q_near, double duration_s,
                                const SweepMotionLimits& limits) {
  KILN_CHECK(duration_s > 0.0, duration_s);
  const Eigen::Isometry3d X_lidar_flange = robot.X_flange_lidar.pose().inverse();
  const Eigen::Isometry3d X_armbase_flange =
      robot.X_base_armbase.pose().inverse() * view.X_base_lidar(view.middle()) * X_lidar_flange;
  if (!isFinite(X_armbase_flange))
    return makeError(ErrorCode::InvalidInput, "the view of the LiDAR is not a number");
  std::vector<Vector6d> postures;
  for (const Vector6d& q : inverseSolutions(robot.arm, X_armbase_flange, q_near))
    postures.push_back(nearestTurn(robot.arm, q, q_near));
  const auto way = [&](const Vector6d& q) {
    return (q - q_near).cwiseAbs().cwiseQuotient(robot.arm.velocity_limit).maxCoeff();
  };
  std::stable_sort(postures.begin(), postures.end(),
                   [&](const Vector6d& a, const Vector6d& b) { return way(a) < way(b); });
  std::string hindered;
  for (const Vector6d& q : postures) {
    const auto from =
        follow(robot, X_lidar_flange, view, view.tilt_from_rad, q, limits.max_step_rad);
    const auto to = follow(robot, X_lidar_flange, view, view.tilt_to_rad, q, limits.max_step_rad);
    if (!from || !to) continue;
    const SweepMotion motion{*from, *to, duration_s};
    std::string why = whatHinders(robot, world, motion, limits);
    if (why.empty()) return motion;
    if (hindered.empty()) hindered = std::move(why);
  }
  if (hindered.empty())
    return makeError(ErrorCode::Degenerate, "no posture of the arm carries the LiDAR through it");
  return makeError(ErrorCode::Refused, "{}", hindered);
}

std::vector<Eigen::Isometry3d> lidarPoses(const RobotGeometry& robot, const SweepMotion& motion,
                                          int count) {
  KILN_CHECK(count >= 2, count);
  const Eigen::Isometry3d X_flange_lidar = robot.X_flange_lidar.pose();
  std::vector<Eigen::Isometry3d> out;
  for (int k = 0; k < count; ++k) {
    const double share = static_cast<double>(k) / (count - 1);
    const Vector6d q = motion.q_from + share * (motion.q_to - motion.q_from);
    out.push_back(robot.X_base_flange(q) * X_flange_lidar);
  }
  return out;
}

LidarView firstLook(const RobotGeometry& robot, double tilt_from_rad, double tilt_to_rad) {
  const Eigen::Isometry3d X =
      robot.X_base_flange(RobotGeometry::radians(robot.q_drive_deg)) * robot.X_flange_lidar.pose();
  const Eigen::Vector3d ahead = X.linear().col(0);
  return {X.translation(), std::atan2(ahead.y(), ahead.x()), tilt_from_rad, tilt_to_rad};
}

}  // namespace kiln
