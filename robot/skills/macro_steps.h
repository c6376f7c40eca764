#pragma once

#include "common/robot_model/robot_geometry.h"
#include "robot/skills/macro.h"
#include "robot/skills/motion.h"

namespace kiln {

struct MacroConfig {
  double arm_step_s = 6.0;  ///< what the list reckons for one arm motion
  void visit(ConfigArchive& a);
};

/// How long a step has run, over all presses.
class StepTimer {
 public:
  void start(Stamp now) {
    before_ = {};
    began_ = now;
  }
  void stop(Stamp now) { before_ += now - began_; }
  void resume(Stamp now) { began_ = now; }
  [[nodiscard]] double elapsedS(Stamp now) const { return toSeconds(before_ + (now - began_)); }

 private:
  Duration before_{};
  Stamp began_;
};

/// A motion of the arm: the subclass says where to.
class ArmMacroStep : public MacroStep {
 public:
  ArmMacroStep(ArmMotion& arm, const MacroConfig& config) : arm_(arm), config_(config) {}
  void addTo(MacroEstimate& estimate) const override { estimate.duration_s += config_.arm_step_s; }
  void start(Stamp now) override;
  [[nodiscard]] SkillStatus poll(Stamp now) override;
  void abort(Stamp) override { arm_.cancel(); }

 protected:
  /// Error: why the arm cannot go there, in words.
  virtual Result<void> begin(Stamp now) = 0;
  ArmMotion& arm_;

 private:
  MacroConfig config_;
  std::string failure_;
};

/// What the robot's own steps work with; all outlive them.
struct MacroParts {
  const RobotGeometry& robot;
  Eigen::Isometry3d X_flange_tool;  ///< the tool that `tool` brings to a pose
  ArmMotion& arm;
  MacroConfig config;
};

/// The kinds that every robot has:
///   arm   pose: park | drive, or q_deg: six joints
///   tool  xyz_m, yaw_deg, pitch_deg: tool exit in base and where it looks (pitch up positive)
///   wait  seconds
[[nodiscard]] MacroStepKinds robotMacroSteps(const MacroParts& parts);
/// What `tool` makes, for a mission that calls its tool by name.
[[nodiscard]] std::function<std::unique_ptr<MacroStep>()> toolMacroStep(const MacroParts& parts);

}  // namespace kiln
