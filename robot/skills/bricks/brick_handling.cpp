#include "robot/skills/bricks/brick_handling.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace kiln {
namespace {

constexpr double kSameTiltCosine = 0.9986;  // 3 deg

Vector6d jointsOf(const Arm& arm) {
  const std::optional<ArmState> state = arm.state();
  return state ? state->q : Vector6d(Vector6d::Zero());
}

}  // namespace

void HandlingConfig::visit(ConfigArchive& a) {
  a.field("line_clearance_m", line_clearance_m, "m", 0, 0.1, "on lines, to what is not touched");
  a.field("touching_m", touching_m, "m", 0, 0.1, "nearer to a brick's place may be touched there");
  a.field("carry_accel_radps2", carry_accel_radps2, "rad/s^2", 0.05, 5, "joints, with a brick");
  a.field("carry_speed_scale", carry_speed_scale, "", 0.01, 1, "of the joint limits, with a brick");
  a.field("guard_n", guard_n, "N", 5, 100, "contact force that stops free motion");
  a.field("zero_s", zero_s, "s", 0.5, 20, "the force sensor is zeroed within");
  a.section("watch", watch, "whether the brick still hangs");
}

BrickHandling::BrickHandling(const HandlingConfig& c, HandlingParts p)
    : config(c), parts(p), watch(c.watch, p.robot) {}

void BrickHandling::begin(std::string text, Stamp now) {
  status = {SkillPhase::Running, 0.0, std::move(text), ""};
  drop.reset();
  began_ = now;
}

SkillStatus BrickHandling::fail(std::string code, std::string text) {
  status = {SkillPhase::Failed, status.progress, std::move(text), std::move(code)};
  return status;
}

SkillStatus BrickHandling::done(std::string text) {
  status = {SkillPhase::Done, 1.0, std::move(text), ""};
  return status;
}

bool BrickHandling::interrupted(double timeout_s, Stamp now) {
  if (parts.arm.tracking().protective_stop) {
    cancel();
    (void)fail("protective_stop",
               brick ? fmt::format("protective stop; the magnets keep {}: look at it, then release "
                                   "the arm",
                                   brick->name)
                     : "protective stop: look at the arm, then release it");
    return true;
  }
  repeatMagnets();
  drop = watch.poll(parts.gripper.state(), parts.device.state(), now);
  if (drop) {
    cancel();
    letGo();
    (void)fail("dropped", fmt::format("{} is gone: {}", drop->name, drop->why));
    return true;
  }
  const std::string blind = watch.brick() ? watch.blind(parts.gripper.state(), now) : "";
  const bool late = toSeconds(now - began_) > timeout_s;
  if (blind.empty() && !late) return false;
  cancel();
  (void)fail("timeout",
             late ? fmt::format("not done within {:.0f} s: {}", timeout_s, status.text) : blind);
  return true;
}

void BrickHandling::cancel() {
  parts.motion.cancel();
  status = {SkillPhase::Idle, status.progress, "cancelled", ""};
}

void BrickHandling::magnets(bool on) {
  wanted_ = on ? MagnetMask().set() : MagnetMask();
  (void)parts.gripper.write(*wanted_);  // said again until the gripper shows it
}

void BrickHandling::repeatMagnets() {
  const std::optional<GripperState> state = parts.gripper.state();
  if (wanted_ && state && state->on != *wanted_) (void)parts.gripper.write(*wanted_);
}

bool BrickHandling::contact() const {
  const std::optional<GripperState> state = parts.gripper.state();
  return state && state->contact;
}

void BrickHandling::tellOf(const HeldBrick& held) {
  brick = held;
  parts.arm.carry(held.payload(parts.robot));
}

void BrickHandling::hold(const HeldBrick& held, Stamp now) {
  tellOf(held);
  watch.begin(held, now);
}

void BrickHandling::letGo() {
  brick.reset();
  watch.end();
  parts.arm.carry({});
}

void BrickHandling::askZero(Stamp now) {
  zeroings_ = parts.arm.tracking().zeroings;
  zero_asked_ = now;
  parts.arm.zeroForce();
}

bool BrickHandling::zeroed() const { return parts.arm.tracking().zeroings != zeroings_; }

bool BrickHandling::zeroOverdue(Stamp now) const {
  return toSeconds(now - zero_asked_) > config.zero_s;
}

std::optional<double> BrickHandling::upForce() const {
  const std::optional<ArmState> state = parts.device.state();
  if (!state || !state->wrench_tool.allFinite()) return std::nullopt;
  return kiln::upForce(parts.robot, *state);
}

Eigen::Isometry3d BrickHandling::X_base_tool() const {
  return parts.robot.X_base_flange(jointsOf(parts.device)) * parts.robot.X_flange_tool.pose();
}

Eigen::Isometry3d BrickHandling::flangeForTool(const Eigen::Isometry3d& X_base_tool) const {
  return X_base_tool * parts.robot.X_flange_tool.pose().inverse();
}

ArmMoveTerms BrickHandling::freely(const std::vector<OrientedBox>& around) const {
  ArmMoveTerms terms;
  terms.scene.boxes = around;
  terms.guard_force_n = config.guard_n;
  if (!brick) return terms;
  terms.carried = brick->inFlange(parts.robot);
  terms.joint_accel_radps2 = config.carry_accel_radps2;
  terms.speed_scale = config.carry_speed_scale;
  terms.keep_tilt = true;  // by shear alone it hardly holds
  return terms;
}

ArmMoveTerms BrickHandling::freelyBefore(const std::vector<OrientedBox>& around,
                                         std::vector<std::string> touchable,
                                         const std::vector<Eigen::Isometry3d>& X_base_tool) const {
  ArmMoveTerms terms = freely(around);
  terms.ahead = LineAhead{{}, std::move(touchable), config.line_clearance_m};
  for (const Eigen::Isometry3d& X : X_base_tool)
    terms.ahead->X_base_flange.push_back(flangeForTool(X));
  return terms;
}

ArmMoveTerms BrickHandling::line(const std::vector<OrientedBox>& around,
                                 std::vector<std::string> touchable, double speed_mps,
                                 double guard_n) const {
  ArmMoveTerms terms = freely(around);
  terms.scene.touchable = std::move(touchable);
  terms.clearance_m = config.line_clearance_m;
  terms.line_speed_mps = speed_mps;
  terms.guard_force_n = guard_n;
  terms.watch = false;  // the live cloud shows the very brick
  return terms;
}

void BrickHandling::lineTo(ArmMoveTerms terms, const std::vector<Eigen::Isometry3d>& X_base_tool,
                           Stamp now) {
  parts.motion.setTerms(std::move(terms));
  std::vector<Eigen::Isometry3d> X_base_flange;
  for (const Eigen::Isometry3d& X : X_base_tool) X_base_flange.push_back(flangeForTool(X));
  parts.motion.startCartesian(std::move(X_base_flange), false, now);
}

bool BrickHandling::sameTilt(const Eigen::Isometry3d& X_base_tool_goal) const {
  const Eigen::Matrix3d here = X_base_tool().linear(), there = X_base_tool_goal.linear();
  return std::abs(here(2, 2) - there(2, 2)) < 1.0 - kSameTiltCosine &&
         std::abs(here(2, 2)) > kSameTiltCosine;
}

Result<double> BrickHandling::wayTo(const Eigen::Isometry3d& X_base_tool) const {
  const auto q = parts.motion.check(flangeForTool(X_base_tool));
  if (!q) return tl::make_unexpected(q.error());
  return (*q - jointsOf(parts.device)).cwiseAbs().maxCoeff();
}

}  // namespace kiln
