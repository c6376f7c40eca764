#pragma once

#include <deque>
#include <functional>

#include <gtest/gtest.h>

#include "robot/skills/bricks/brick_handling.h"
#include "tests/support/fake_devices.h"
#include "tests/support/paths.h"

namespace kiln {

/// A gripper whose switch the test presses. `stands`: its last state keeps its stamp.
class FakeGripper final : public Gripper {
 public:
  explicit FakeGripper(const Clock& clock) : clock_(clock) {}
  [[nodiscard]] std::optional<GripperState> state() const override {
    if (!stands) stamp_ = clock_.now();
    GripperState out;
    out.stamp = stamp_;
    out.on = on;
    out.contact = contact;
    return out;
  }
  Result<void> write(const MagnetMask& wanted) override {
    if (deaf_writes-- > 0) return {};
    on = wanted;
    return {};
  }
  MagnetMask on;
  bool contact = false, stands = false;
  int deaf_writes = 0;

 private:
  const Clock& clock_;
  mutable Stamp stamp_;
};

/// Motions that end as the test says, one poll after their start: "" is there, "contact" met
/// something, "never" goes on. None left: as `rule` says by their terms, without one: there.
class ToldMotion : public ArmMotion {
 public:
  void setTerms(ArmMoveTerms given) override { terms = std::move(given); }
  void startJoints(const Vector6d&, Stamp) override { begin({}); }
  void startTimed(const Vector6d&, double, Stamp) override { begin({}); }
  void startPose(const Eigen::Isometry3d& X, Stamp) override { begin(X); }
  void startCartesian(std::vector<Eigen::Isometry3d> poses, bool, Stamp) override {
    begin(poses.back());
  }
  void startBack(double, Stamp) override { begin({}); }
  [[nodiscard]] SkillStatus poll(Stamp) override {
    if (ending == "never") return {SkillPhase::Running, 0.5, "goes on", ""};
    if (ending.empty()) return {SkillPhase::Done, 1.0, "there", ""};
    return {SkillPhase::Failed, 0.5, "told so", ending};
  }
  void cancel() override { ++cancels; }
  [[nodiscard]] Result<Vector6d> check(const Eigen::Isometry3d&) const override {
    if (!refused) return Vector6d::Zero().eval();
    return tl::make_unexpected(*refused);
  }

  std::deque<std::string> endings;
  std::function<std::string(const ArmMoveTerms&)> rule;
  std::optional<Error> refused;
  std::vector<Eigen::Isometry3d> goals;  ///< X_base_flange of each start
  std::vector<ArmMoveTerms> under;       ///< the terms of each
  ArmMoveTerms terms;
  std::string ending;
  int cancels = 0;

 private:
  void begin(const Eigen::Isometry3d& X_base_flange) {
    goals.push_back(X_base_flange);
    under.push_back(terms);
    ending = rule ? rule(terms) : "";
    if (endings.empty()) return;
    ending = endings.front();
    endings.pop_front();
  }
};

/// Skills with bricks on devices that do as they are told.
struct FakeHandling {
  FakeHandling() {
    EXPECT_TRUE(loadConfig(sourceDir() + "/resources/robot_model/mario.yaml", robot).has_value());
    arm.setQ(RobotGeometry::radians(robot.q_drive_deg));
    run(0.8);
  }
  void step() {
    clock.advanceBy(std::chrono::milliseconds(4));
    arm.advance();
    if (++steps % 2 == 0) controller.tick(clock.now());
  }
  void run(double seconds) {
    for (const Stamp end = clock.now() + fromSeconds(seconds); clock.now() < end;) step();
  }
  /// Polls at 50 Hz. @param each  before each poll.
  template <class Skill>
  SkillStatus work(
      Skill& skill, double limit_s, const std::function<void()>& each = [] {}) {
    SkillStatus status = skill.poll(clock.now());
    for (const Stamp end = clock.now() + fromSeconds(limit_s); clock.now() < end;) {
      if (status.phase != SkillPhase::Running) break;
      for (int i = 0; i < 5; ++i) step();
      each();
      status = skill.poll(clock.now());
    }
    return status;
  }
  [[nodiscard]] KnownBrick red() const {
    KnownBrick out{"red 1", BrickKind::Red, Eigen::Isometry3d::Identity()};
    out.X_frame_brick.translation() << 1.0, 0.0, 0.1;
    return out;
  }

  ManualClock clock{Stamp{std::chrono::seconds(10)}};
  RobotGeometry robot;
  FakeArm arm{clock, robot, Vector6d::Zero()};
  StopLatch stop;
  ArmController controller{{}, robot, arm, stop};
  FakeGripper gripper{clock};
  ToldMotion motion;
  HandlingParts parts{robot, motion, controller, arm, gripper};
  int steps = 0;
};

}  // namespace kiln
