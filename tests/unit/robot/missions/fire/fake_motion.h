#pragma once

#include <functional>
#include <map>

#include "common/robot_model/robot_geometry.h"
#include "robot/skills/motion.h"
#include "tests/support/fake_devices.h"

namespace kiln {

/// An arm skill that goes where it is told along straight joint lines, without dynamics or
/// obstacles. Its inverse kinematics is a damped Newton search. `onStart` may make a motion fail.
class FakeArmMotion final : public ArmMotion {
 public:
  FakeArmMotion(const RobotGeometry& robot, FakeArm& device) : robot_(robot), device_(device) {}
  void setTerms(ArmMoveTerms) override {}

  void startJoints(const Vector6d& q_goal, Stamp now) override;
  /// At the fake's own speed, whatever the duration.
  void startTimed(const Vector6d& q_goal, double duration_s, Stamp now) override;
  void startPose(const Eigen::Isometry3d& X_base_flange, Stamp now) override;
  void startCartesian(std::vector<Eigen::Isometry3d> X_base_flange, bool blend, Stamp now) override;
  /// To where the last motion began.
  void startBack(double seconds, Stamp now) override;
  [[nodiscard]] SkillStatus poll(Stamp now) override;
  void cancel() override { moving_ = false; }
  [[nodiscard]] Result<Vector6d> check(const Eigen::Isometry3d& X_base_flange) const override;

  [[nodiscard]] bool moving() const { return moving_; }
  [[nodiscard]] const Vector6d& goal() const { return path_.back(); }
  /// The next motion of a kind ("joints", "pose", "cartesian") fails half-way with this code; with
  /// "stuck" at once.
  void failNext(const std::string& kind, const std::string& code) {
    failures_[kind].push_back(code);
  }
  std::function<bool(const Eigen::Isometry3d& X_base_flange)>
      reachable;  ///< empty: by kinematics alone

 private:
  void begin(const std::string& kind, std::vector<Vector6d> path, Stamp now);
  [[nodiscard]] std::optional<Vector6d> solve(const Eigen::Isometry3d& X_base_flange,
                                              Vector6d q) const;

  const RobotGeometry& robot_;
  FakeArm& device_;
  std::map<std::string, std::vector<std::string>> failures_;
  std::vector<Vector6d> path_;
  double travelled_ = 0.0;  ///< rad, largest joint
  double length_ = 0.0;
  std::string fail_code_;
  bool moving_ = false;
  Stamp last_;
  SkillStatus ended_;
};

/// A base skill that moves its pose along the way-points at 1 m/s.
class FakeBaseMotion final : public BaseMotion {
 public:
  explicit FakeBaseMotion(const Pose2& start) : pose_(start) {}
  void start(std::vector<Pose2> waypoints_map, Stamp now) override;
  [[nodiscard]] SkillStatus poll(Stamp now) override;
  void cancel() override { moving_ = false; }

  [[nodiscard]] const Pose2& pose() const { return pose_; }
  void carryTo(const Pose2& pose) { pose_ = pose; }
  [[nodiscard]] bool moving() const { return moving_; }
  void failNext(int count) { failures_ = count; }
  void stickForever() { stuck_ = true; }
  int drives = 0;

 private:
  std::vector<Pose2> waypoints_;
  Pose2 pose_;
  Stamp last_;
  bool moving_ = false;
  bool stuck_ = false;
  int failures_ = 0;
};

}  // namespace kiln
