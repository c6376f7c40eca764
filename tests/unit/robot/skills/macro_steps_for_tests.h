#pragma once

#include "robot/skills/macro_steps.h"

namespace kiln {

/// An arm whose every motion takes half a second, or fails.
class ScriptedArm final : public ArmMotion {
 public:
  void setTerms(ArmMoveTerms) override {}
  void startJoints(const Vector6d& q, Stamp now) override {
    q_goal = q;
    begin(now);
  }
  void startTimed(const Vector6d& q, double, Stamp now) override { startJoints(q, now); }
  void startPose(const Eigen::Isometry3d& X_base_flange, Stamp now) override {
    X_goal = X_base_flange;
    begin(now);
  }
  void startCartesian(std::vector<Eigen::Isometry3d> poses, bool, Stamp now) override {
    begin(now);
    last_round = poses.size();
  }
  void startBack(double, Stamp now) override { begin(now); }
  SkillStatus poll(Stamp now) override {
    if (!fail.empty()) return {SkillPhase::Failed, 0.0, fail, "contact"};
    if (!moving) return {};
    const double s = toSeconds(now - started) / 0.5;
    if (s >= 1.0) moving = false;
    return {s >= 1.0 ? SkillPhase::Done : SkillPhase::Running, std::min(1.0, s), "", ""};
  }
  void cancel() override {
    moving = false;
    ++cancels;
  }
  Result<Vector6d> check(const Eigen::Isometry3d&) const override {
    return Vector6d::Zero().eval();
  }

  bool moving = false;
  int starts = 0, cancels = 0;
  std::size_t last_round = 0;
  Vector6d q_goal = Vector6d::Zero();
  Eigen::Isometry3d X_goal = Eigen::Isometry3d::Identity();
  std::string fail;

 private:
  void begin(Stamp now) {
    moving = true;
    started = now;
    ++starts;
  }
  Stamp started;
};

/// A step that a mission could bring: a light that is on for a time.
class LightStep final : public MacroStep {
 public:
  explicit LightStep(bool& on) : on_(on) {}
  void visit(ConfigArchive& a) override {
    a.field("seconds", seconds_, "s", 0.1, 120.0, "on for so long");
    a.field("colour", colour_, "of the light");
  }
  [[nodiscard]] std::string problem() const override {
    return colour_.empty() ? "light: 'colour' is missing" : "";
  }
  [[nodiscard]] std::string text() const override { return colour_ + " light"; }
  void addTo(MacroEstimate& estimate) const override {
    estimate.duration_s += seconds_;
    estimate.uses["l"] += 0.1 * seconds_;
  }
  void start(Stamp now) override { timer_.start(now); }
  void resume(Stamp now) override { timer_.resume(now); }
  [[nodiscard]] SkillStatus poll(Stamp now) override {
    on_ = timer_.elapsedS(now) < seconds_;
    return {on_ ? SkillPhase::Running : SkillPhase::Done, timer_.elapsedS(now) / seconds_, "", ""};
  }
  void abort(Stamp now) override {
    timer_.stop(now);
    on_ = false;
  }

 private:
  bool& on_;
  double seconds_ = 1.0;
  std::string colour_;
  StepTimer timer_;
};

/// The robot's own kinds and `light`.
inline MacroStepKinds testSteps(const RobotGeometry& robot, ArmMotion& arm, bool& light) {
  MacroStepKinds kinds = robotMacroSteps({robot, Eigen::Isometry3d::Identity(), arm, {}});
  kinds.push_back({"light", [&light] { return std::make_unique<LightStep>(light); }});
  return kinds;
}

}  // namespace kiln
