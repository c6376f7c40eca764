#include "robot/skills/macro_steps.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "common/core/units.h"

namespace kiln {
namespace {

class JointsStep final : public ArmMacroStep {
 public:
  explicit JointsStep(const MacroParts& parts)
      : ArmMacroStep(parts.arm, parts.config), robot_(parts.robot) {}
  void visit(ConfigArchive& a) override {
    a.choice("pose", pose_, {"park", "drive"}, "named pose of the robot model");
    a.field("q_deg", q_deg_, "deg", -360.0, 360.0, "or six joint angles, shoulder pan to wrist 3");
  }
  [[nodiscard]] std::string problem() const override {
    if (pose_.empty() == q_deg_.empty()) return "arm: give either 'pose' or 'q_deg'";
    return pose_.empty() && q_deg_.size() != 6 ? "arm: 'q_deg' needs six angles" : "";
  }
  [[nodiscard]] std::string text() const override {
    return pose_.empty() ? "arm to its joints" : "arm to " + pose_;
  }

 private:
  Result<void> begin(Stamp now) override {
    const auto& q_deg = pose_ == "park"    ? robot_.q_park_deg
                        : pose_ == "drive" ? robot_.q_drive_deg
                                           : q_deg_;
    arm_.startJoints(RobotGeometry::radians(q_deg), now);
    return {};
  }
  const RobotGeometry& robot_;
  std::string pose_;
  std::vector<double> q_deg_;
};

class ToolStep final : public ArmMacroStep {
 public:
  explicit ToolStep(const MacroParts& parts)
      : ArmMacroStep(parts.arm, parts.config), X_tool_flange_(parts.X_flange_tool.inverse()) {}
  void visit(ConfigArchive& a) override {
    a.field("xyz_m", xyz_m_, "m", -2.5, 2.5, "tool exit in base");
    a.field("yaw_deg", yaw_deg_, "deg", -180.0, 180.0, "where the tool looks; 0 is forward");
    a.field("pitch_deg", pitch_deg_, "deg", -80.0, 80.0, "upwards positive");
  }
  [[nodiscard]] std::string text() const override {
    return fmt::format("tool to {:.2f}, {:.2f}, {:.2f} m", xyz_m_[0], xyz_m_[1], xyz_m_[2]);
  }

 private:
  Result<void> begin(Stamp now) override {
    const Eigen::Vector3d p(xyz_m_[0], xyz_m_[1], xyz_m_[2]);
    // Positive pitch looks up, which is a negative turn about Y.
    const auto X_base_tool = makePose(p, {0.0, -pitch_deg_ * kDeg, yaw_deg_ * kDeg});
    arm_.startPose(X_base_tool * X_tool_flange_, now);
    return {};
  }
  Eigen::Isometry3d X_tool_flange_;
  std::vector<double> xyz_m_{1.3, 0.0, 1.1};
  double yaw_deg_ = 0.0, pitch_deg_ = 0.0;
};

class WaitStep final : public MacroStep {
 public:
  void visit(ConfigArchive& a) override { a.field("seconds", seconds_, "s", 0.1, 60.0, "pause"); }
  [[nodiscard]] std::string text() const override { return fmt::format("wait {:.0f} s", seconds_); }
  void addTo(MacroEstimate& estimate) const override { estimate.duration_s += seconds_; }
  void start(Stamp now) override { timer_.start(now); }
  void resume(Stamp now) override { timer_.resume(now); }
  [[nodiscard]] SkillStatus poll(Stamp now) override {
    const double elapsed_s = timer_.elapsedS(now);
    return {elapsed_s >= seconds_ ? SkillPhase::Done : SkillPhase::Running,
            std::min(1.0, elapsed_s / seconds_), "", ""};
  }
  void abort(Stamp now) override { timer_.stop(now); }

 private:
  double seconds_ = 1.0;
  StepTimer timer_;
};

}  // namespace

void MacroConfig::visit(ConfigArchive& a) {
  a.field("arm_step_s", arm_step_s, "s", 0.5, 60.0, "what the list reckons for one arm motion");
}

void ArmMacroStep::start(Stamp now) {
  const auto begun = begin(now);
  failure_ = begun ? std::string() : begun.error().message;
}

SkillStatus ArmMacroStep::poll(Stamp now) {
  if (!failure_.empty()) return {SkillPhase::Failed, 0.0, failure_, "unreachable"};
  return arm_.poll(now);
}

MacroStepKinds robotMacroSteps(const MacroParts& parts) {
  return {{"arm", [parts] { return std::make_unique<JointsStep>(parts); }},
          {"tool", toolMacroStep(parts)},
          {"wait", [] { return std::make_unique<WaitStep>(); }}};
}

std::function<std::unique_ptr<MacroStep>()> toolMacroStep(const MacroParts& parts) {
  return [parts] { return std::make_unique<ToolStep>(parts); };
}

}  // namespace kiln
