#include "tests/unit/robot/missions/fire/fake_motion.h"

#include <cmath>

namespace kiln {
namespace {
constexpr double kJointSpeed = 0.8;  // rad/s
constexpr double kBaseSpeed = 1.0;   // m/s

double largest(const Vector6d& a, const Vector6d& b) { return (a - b).cwiseAbs().maxCoeff(); }
}  // namespace

std::optional<Vector6d> FakeArmMotion::solve(const Eigen::Isometry3d& X_base_flange,
                                             Vector6d q) const {
  const Eigen::Isometry3d X_goal = robot_.X_base_armbase.pose().inverse() * X_base_flange;
  for (int i = 0; i < 100; ++i) {
    const Eigen::Isometry3d X = robot_.arm.forward(q);
    const Eigen::AngleAxisd turn(Eigen::Matrix3d(X_goal.linear() * X.linear().transpose()));
    Vector6d error;
    error << X_goal.translation() - X.translation(), turn.angle() * turn.axis();
    if (error.norm() < 1e-5) return q;
    const auto J = robot_.arm.jacobian(q);
    const Eigen::Matrix<double, 6, 6> damped =
        J * J.transpose() + 1e-3 * Eigen::Matrix<double, 6, 6>::Identity();
    const Vector6d dq = J.transpose() * damped.ldlt().solve(error);
    q += dq * std::min(1.0, 0.5 / std::max(1e-9, dq.cwiseAbs().maxCoeff()));
  }
  return std::nullopt;
}

Result<Vector6d> FakeArmMotion::check(const Eigen::Isometry3d& X_base_flange) const {
  if (reachable && !reachable(X_base_flange))
    return makeError(ErrorCode::Refused, "out of reach in this test");
  // From the present joints, else from an arm stretched forward.
  const Vector6d q_forward = RobotGeometry::radians({0, -110, 120, -10, 90, 180});
  for (const Vector6d& seed : {device_.state()->q, q_forward})
    if (const auto q = solve(X_base_flange, seed)) return *q;
  return makeError(ErrorCode::Refused, "no inverse kinematics");
}

void FakeArmMotion::begin(const std::string& kind, std::vector<Vector6d> path, Stamp now) {
  path.insert(path.begin(), device_.state()->q);
  path_ = std::move(path);
  length_ = 0.0;
  for (std::size_t i = 1; i < path_.size(); ++i) length_ += largest(path_[i - 1], path_[i]);
  travelled_ = 0.0;
  fail_code_.clear();
  if (auto& pending = failures_[kind]; !pending.empty()) {
    fail_code_ = pending.front();
    pending.erase(pending.begin());
  }
  moving_ = true;
  last_ = now;
}

void FakeArmMotion::startJoints(const Vector6d& q_goal, Stamp now) {
  begin("joints", {q_goal}, now);
}

void FakeArmMotion::startTimed(const Vector6d& q_goal, double, Stamp now) {
  begin("timed", {q_goal}, now);
}

void FakeArmMotion::startPose(const Eigen::Isometry3d& X_base_flange, Stamp now) {
  const auto q = check(X_base_flange);
  begin("pose", {q ? *q : device_.state()->q}, now);
  if (!q) fail_code_ = "unreachable";
}

void FakeArmMotion::startCartesian(std::vector<Eigen::Isometry3d> X_base_flange, bool blend,
                                   Stamp now) {
  (void)blend;
  std::vector<Vector6d> path;
  Vector6d q = device_.state()->q;
  bool all = true;
  for (const Eigen::Isometry3d& X : X_base_flange) {
    const auto next = solve(X, q);
    all = all && next.has_value();
    if (next) path.push_back(q = *next);
  }
  begin("cartesian", std::move(path), now);
  if (!all) fail_code_ = "unreachable";
}

void FakeArmMotion::startBack(double, Stamp now) {
  begin("back", {path_.empty() ? device_.state()->q : path_.front()}, now);
}

SkillStatus FakeArmMotion::poll(Stamp now) {
  if (!moving_) return ended_;
  travelled_ += kJointSpeed * toSeconds(now - last_);
  last_ = now;
  double left = std::min(travelled_, length_);
  Vector6d q = path_.back();
  for (std::size_t i = 1; i < path_.size(); ++i) {
    const double step = largest(path_[i - 1], path_[i]);
    if (left < step) {
      q = path_[i - 1] + (path_[i] - path_[i - 1]) * (left / step);
      break;
    }
    left -= step;
  }
  if (fail_code_ != "stuck") device_.setQ(q);
  const double progress = length_ > 0.0 ? std::min(1.0, travelled_ / length_) : 1.0;
  if (!fail_code_.empty() && (progress >= 0.5 || fail_code_ == "stuck")) {
    moving_ = false;
    ended_ = {SkillPhase::Failed, progress, "arm stopped: " + fail_code_, fail_code_};
  } else if (progress >= 1.0) {
    moving_ = false;
    ended_ = {SkillPhase::Done, 1.0, "there", {}};
  } else {
    return {SkillPhase::Running, progress, "moving", {}};
  }
  return ended_;
}

void FakeBaseMotion::start(std::vector<Pose2> waypoints_map, Stamp now) {
  waypoints_ = std::move(waypoints_map);
  last_ = now;
  moving_ = true;
  ++drives;
}

SkillStatus FakeBaseMotion::poll(Stamp now) {
  double way = stuck_ ? 0.0 : kBaseSpeed * toSeconds(now - last_);
  last_ = now;
  if (failures_ > 0) {
    --failures_;
    moving_ = false;
    return {SkillPhase::Failed, 0.0, "the wheels do not turn", "timeout"};
  }
  while (!waypoints_.empty()) {
    const Pose2& goal = waypoints_.front();
    const double distance = std::hypot(goal.x_m - pose_.x_m, goal.y_m - pose_.y_m);
    if (distance > way) {
      pose_.x_m += (goal.x_m - pose_.x_m) * way / distance;
      pose_.y_m += (goal.y_m - pose_.y_m) * way / distance;
      return {SkillPhase::Running, 0.5, "driving", {}};
    }
    way -= distance;
    pose_ = goal;
    waypoints_.erase(waypoints_.begin());
  }
  moving_ = false;
  return {SkillPhase::Done, 1.0, "there", {}};
}

}  // namespace kiln
