#pragma once

#include <optional>
#include <string>
#include <vector>

#include "robot/control/arm_controller.h"
#include "robot/hal/gripper.h"
#include "robot/skills/bricks/held_brick_watch.h"
#include "robot/skills/motion.h"

namespace kiln {

/// What the skills with bricks work with; all outlive them.
struct HandlingParts {
  const RobotGeometry& robot;
  ArmMotion& motion;
  ArmController& arm;
  const Arm& device;
  Gripper& gripper;
};

/// How the arm moves near bricks and with one.
struct HandlingConfig {
  double line_clearance_m = 0.004;  ///< on straight lines, to what must not be touched
  double touching_m = 0.02;         ///< what is nearer to a brick in its place may be touched there
  double carry_accel_radps2 =
      0.7;                         ///< of the joints: 20 N of shear hold a long brick against turns
  double carry_speed_scale = 0.2;  ///< of the joint limits
  double guard_n = 40.0;           ///< whatever is met on the way
  double zero_s = 3.0;             ///< the force sensor is zeroed within
  HeldBrickWatch::Config watch;
  void visit(ConfigArchive& a);
};

/// What picking and placing have in common: the state of the skill, magnets, force, and how a
/// motion's end is told. Magnets keep their state whatever fails: a brick that falls is worse.
/// Confined to the mission thread.
class BrickHandling {
 public:
  BrickHandling(const HandlingConfig& config, HandlingParts parts);

  // The skill's state.
  void begin(std::string text, Stamp now);
  SkillStatus fail(std::string code, std::string text);
  SkillStatus done(std::string text);
  [[nodiscard]] bool running() const { return status.phase == SkillPhase::Running; }
  /// What ends any stage: a protective stop, a brick that is gone, a silent gripper, the time
  /// limit. @return whether the skill has ended.
  [[nodiscard]] bool interrupted(double timeout_s, Stamp now);
  void cancel();

  // Magnets and force.
  void magnets(bool on);
  [[nodiscard]] bool contact() const;
  /// The arm's payload and the watch follow.
  void hold(const HeldBrick& brick, Stamp now);
  void letGo();
  /// The device is told of it, but nothing is watched yet.
  void tellOf(const HeldBrick& brick);
  void askZero(Stamp now);
  [[nodiscard]] bool zeroed() const;
  [[nodiscard]] bool zeroOverdue(Stamp now) const;
  [[nodiscard]] std::optional<double> upForce() const;

  // Poses, in base.
  [[nodiscard]] Eigen::Isometry3d X_base_tool() const;  ///< by the measured joints
  [[nodiscard]] Eigen::Isometry3d flangeForTool(const Eigen::Isometry3d& X_base_tool) const;

  // Motions.
  /// Free motion with or without a brick, full clearance.
  [[nodiscard]] ArmMoveTerms freely(const std::vector<OrientedBox>& around) const;
  /// The same, to where these straight lines begin: on them what is named may be touched.
  [[nodiscard]] ArmMoveTerms freelyBefore(const std::vector<OrientedBox>& around,
                                          std::vector<std::string> touchable,
                                          const std::vector<Eigen::Isometry3d>& X_base_tool) const;
  /// A straight line on which these may be touched.
  [[nodiscard]] ArmMoveTerms line(const std::vector<OrientedBox>& around,
                                  std::vector<std::string> touchable, double speed_mps,
                                  double guard_n) const;
  void lineTo(ArmMoveTerms terms, const Eigen::Isometry3d& X_base_tool, Stamp now) {
    lineTo(std::move(terms), std::vector{X_base_tool}, now);
  }
  void lineTo(ArmMoveTerms terms, const std::vector<Eigen::Isometry3d>& X_base_tool, Stamp now);
  /// Does the face keep its tilt between here and there?
  [[nodiscard]] bool sameTilt(const Eigen::Isometry3d& X_base_tool_goal) const;
  /// How far the joints are from holding the face so, rad, under the terms that were set last.
  /// Error: it cannot be held so, and why.
  [[nodiscard]] Result<double> wayTo(const Eigen::Isometry3d& X_base_tool) const;

  HandlingConfig config;
  HandlingParts parts;
  SkillStatus status;
  HeldBrickWatch watch;
  std::optional<BrickDrop> drop;
  std::optional<HeldBrick> brick;  ///< told to the arm

 private:
  void repeatMagnets();
  std::optional<MagnetMask> wanted_;
  Stamp began_, zero_asked_;
  std::uint32_t zeroings_ = 0;
};

}  // namespace kiln
