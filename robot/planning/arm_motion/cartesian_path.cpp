#include "robot/planning/arm_motion/cartesian_path.h"

#include <algorithm>
#include <cmath>

#include "robot/planning/arm_motion/ur_inverse.h"
#include "robot/planning/corner_window.h"

namespace kiln {
namespace {

struct PosePath {
  std::vector<double> s;
  std::vector<Eigen::Isometry3d> X;
  std::vector<std::size_t> corners;  ///< samples at which two lines meet
};

constexpr double kRetreatSlack = 1e-3;  // m
constexpr double kNoWay = 1e-4;         // m; shorter lines are no lines

double wayBetween(const Eigen::Isometry3d& from, const Eigen::Isometry3d& to,
                  const CartesianPathConfig& config) {
  return std::max((to.translation() - from.translation()).norm(),
                  rotationAngle(from.inverse() * to) * config.rotation_weight_m);
}

void appendLine(PosePath& path, const Eigen::Isometry3d& to, const CartesianPathConfig& config) {
  const Eigen::Isometry3d from = path.X.back();
  const double length = wayBetween(from, to, config);
  if (length < kNoWay) return;
  const int steps = std::max(2, static_cast<int>(std::ceil(length / config.step_m)));
  const double start = path.s.back();
  if (path.X.size() > 1) path.corners.push_back(path.X.size() - 1);
  for (int k = 1; k <= steps; ++k) {
    const double part = static_cast<double>(k) / steps;
    path.s.push_back(start + part * length);
    path.X.push_back(interpolate(from, to, part));
  }
  path.X.back() = to;
}

/// Mean pose of neighbouring samples. Over a corner of two lines this is a parabola.
Eigen::Isometry3d meanPose(const PosePath& path, std::size_t from, std::size_t to) {
  Eigen::Vector3d p = Eigen::Vector3d::Zero();
  Eigen::Vector4d quaternion = Eigen::Vector4d::Zero();
  for (std::size_t k = from; k <= to; ++k) {
    p += path.X[k].translation();
    const Eigen::Quaterniond q(path.X[k].linear());
    quaternion += quaternion.dot(q.coeffs()) < 0.0 ? -q.coeffs() : q.coeffs();
  }
  Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
  X.translation() = p / static_cast<double>(to - from + 1);
  X.linear() = Eigen::Quaterniond(Eigen::Vector4d(quaternion.normalized())).toRotationMatrix();
  return X;
}

PosePath rounded(const PosePath& path, const CartesianPathConfig& config) {
  PosePath out = path;
  const auto wanted = static_cast<std::size_t>(config.blend_radius_m / config.step_m);
  const auto window = cornerWindows(path.X.size(), path.corners, wanted);
  for (std::size_t k = 1; k + 1 < path.X.size(); ++k) {
    if (window[k] > 0) out.X[k] = meanPose(path, k - window[k], k + window[k]);
  }
  for (std::size_t k = 1; k < out.X.size(); ++k) {
    out.s[k] = out.s[k - 1] + wayBetween(out.X[k - 1], out.X[k], config);
  }
  return out;
}

Eigen::Isometry3d orthonormal(Eigen::Isometry3d X) {
  X.linear() = Eigen::Quaterniond(X.linear()).normalized().toRotationMatrix();
  return X;
}

Result<JointPath> toJoints(const RobotGeometry& robot, const ArmCollision& collision,
                           const CartesianPathConfig& config, const Vector6d& q_start,
                           const PosePath& poses) {
  const Eigen::Isometry3d X_armbase_base = robot.X_base_armbase.pose().inverse();
  JointPath path{poses.s, {q_start}};
  // An arm that is too near to something already must be able to retreat, but not to come nearer.
  const double least = std::min(config.clearance_m, collision.distance(q_start) - kRetreatSlack);
  for (std::size_t k = 1; k < poses.X.size(); ++k) {
    const Vector6d& before = path.q.back();
    Vector6d best = before;
    double best_step = INFINITY;
    for (const Vector6d& q :
         inverseSolutions(robot.arm, X_armbase_base * orthonormal(poses.X[k]), before)) {
      const Vector6d near = nearestTurn(robot.arm, q, before);
      const double step = (near - before).cwiseAbs().maxCoeff();
      if (step < best_step && withinLimits(robot.arm, near)) {
        best_step = step;
        best = near;
      }
    }
    const Eigen::Vector3d p = poses.X[k].translation();
    if (best_step > config.max_joint_step_rad) {
      return makeError(ErrorCode::Degenerate,
                       "the line cannot be followed at flange ({:.2f}, {:.2f}, {:.2f}) in base: {}",
                       p.x(), p.y(), p.z(),
                       std::isfinite(best_step) ? "a joint would have to jump" : "out of reach");
    }
    const double room = collision.distance(best, std::max(0.0, least) + kRetreatSlack);
    if (room < least) {
      return makeError(ErrorCode::Refused,
                       "the line comes within {:.0f} mm at flange ({:.2f}, {:.2f}, {:.2f}): {}",
                       1e3 * room, p.x(), p.y(), p.z(), collision.clearance(best).what);
    }
    path.q.push_back(best);
  }
  return path;
}

}  // namespace

void CartesianPathConfig::visit(ConfigArchive& a) {
  a.field("step_m", step_m, "m", 0.001, 0.05, "spacing of the inverse kinematics");
  a.field("rotation_weight_m", rotation_weight_m, "m/rad", 0.05, 2, "way that 1 rad counts as");
  a.field("blend_radius_m", blend_radius_m, "m", 0, 0.3, "way around a corner that is rounded");
  a.field("max_joint_step_rad", max_joint_step_rad, "rad", 0.01, 1, "more leaves the branch");
}

std::size_t posesBehind(const CartesianPathConfig& config, const Eigen::Isometry3d& X_from,
                        const std::vector<Eigen::Isometry3d>& X_base_flange, double covered) {
  std::vector<double> way;
  double length = 0.0;
  const Eigen::Isometry3d* last = &X_from;
  for (const Eigen::Isometry3d& X : X_base_flange) {
    way.push_back(length += wayBetween(*last, X, config));
    last = &X;
  }
  std::size_t behind = 0;
  while (behind + 1 < way.size() && way[behind] < covered * length) ++behind;
  return behind;
}

Result<std::vector<JointPath>> cartesianPaths(
    const RobotGeometry& robot, const ArmCollision& collision, const CartesianPathConfig& config,
    const Vector6d& q_start, const std::vector<Eigen::Isometry3d>& X_base_flange, bool blend) {
  std::vector<PosePath> lines;
  PosePath line{{0.0}, {robot.X_base_flange(q_start)}, {}};
  for (const Eigen::Isometry3d& to : X_base_flange) {
    appendLine(line, to, config);
    if (!blend) {
      lines.push_back(line);
      line = PosePath{{0.0}, {to}, {}};
    }
  }
  if (blend) lines.push_back(rounded(line, config));
  std::vector<JointPath> out;
  Vector6d q = q_start;
  for (const PosePath& poses : lines) {
    if (poses.X.size() < 2) continue;  // already there
    auto path = toJoints(robot, collision, config, q, poses);
    if (!path) return tl::make_unexpected(path.error());
    q = path->q.back();
    out.push_back(std::move(*path));
  }
  if (out.empty()) out.push_back(straightJointPath(q_start, q_start));
  return out;
}

}  // namespace kiln
