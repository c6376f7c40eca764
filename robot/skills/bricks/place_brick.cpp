#include "robot/skills/bricks/place_brick.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace kiln {
namespace {

constexpr double kReadyAbove_m = 0.01;  // the second lowering begins a few millimetres up

Eigen::Isometry3d moved(const Eigen::Isometry3d& X_base_brick, const Eigen::Vector3d& by_base) {
  return Eigen::Translation3d(by_base) * X_base_brick;
}

Eigen::Isometry3d turned(const Eigen::Isometry3d& X_base_brick, bool half_turn) {
  if (!half_turn) return X_base_brick;
  return X_base_brick * Eigen::AngleAxisd(M_PI, Eigen::Vector3d::UnitZ());
}

}  // namespace

void PlaceBrick::Config::visit(ConfigArchive& a) {
  a.field("above_m", above_m, "m", 0.03, 0.5, "carried to so far above the slot");
  a.field("apart_m", apart_m, "m", 0, 0.2, "and so far from the neighbour");
  a.field("enter_mps", enter_mps, "m/s", 0.005, 0.3, "through the mouth of a bin");
  a.field("inside_mps", inside_mps, "m/s", 0.005, 0.3, "inside of it");
  a.field("enter_n", enter_n, "N", 3, 60, "that counts as met there");
  a.field("near_m", near_m, "m", 0.002, 0.1, "lowered slowly from so far above it");
  a.field("aside_m", aside_m, "m", 0, 0.1, "and there so far from the neighbour");
  a.field("beyond_m", beyond_m, "m", 0, 0.1, "led so far below the slot");
  a.field("early_m", early_m, "m", 0.002, 0.1, "felt higher above the slot: no support");
  a.field("lower_mps", lower_mps, "m/s", 0.002, 0.1, "until the support is felt");
  a.field("support_n", support_n, "N", 3, 60, "that counts as felt");
  a.field("raise_m", raise_m, "m", 0.001, 0.05, "off its support while it is led sideways");
  a.field("side_mps", side_mps, "m/s", 0.001, 0.05, "towards the neighbour");
  a.field("side_n", side_n, "N", 2, 15, "that counts as felt");
  a.field("side_past_m", side_past_m, "m", 0, 0.1, "beyond the slot, if nothing is felt");
  a.field("joint_m", joint_m, "m", 0, 0.02, "back from what was felt");
  a.field("release_s", release_s, "s", 0.05, 5, "after the magnets are off");
  a.field("leave_m", leave_m, "m", 0.02, 0.6, "back along the plate's normal");
  a.field("leave_mps", leave_mps, "m/s", 0.01, 0.3, "slowly");
  a.field("stuck_m", stuck_m, "m", 0.003, 0.1, "so far away the switch must be open");
  a.field("timeout_s", timeout_s, "s", 5, 600, "of all of it");
  a.section("handling", handling, "motion near bricks and with one");
}

PlaceBrick::PlaceBrick(Config config, HandlingParts parts)
    : config_(std::move(config)), base_(config_.handling, parts) {}

void PlaceBrick::enter(Stage stage, std::string text, Stamp now) {
  stage_ = stage;
  stage_began_ = now;
  base_.status.text = std::move(text);
}

void PlaceBrick::start(PlaceRequest request, Stamp now) {
  request_ = std::move(request);
  placement_.reset();
  neighbour_felt_ = false;
  base_.begin("carries the brick", now);
  base_.magnets(true);
  base_.hold(request_.brick, now);
  const Eigen::Vector3d size(brickShape(request_.brick.kind).length_m, kBrickSide_m, kBrickSide_m);
  const OrientedBox there = makeBox(request_.X_base_slot, size, request_.brick.name);
  std::vector<OrientedBox> near = request_.around;
  for (const BoxConfig& box : base_.parts.robot.body)  // the deck below the floor of a bin
    near.push_back(
        makeBox(box.center.pose(), Eigen::Map<const Eigen::Vector3d>(box.size_m.data()), box.name));
  touchable_ = touchedBy(there, near, config_.handling.touching_m);
  turns_.clear();
  Error why;
  for (const bool half_turn : {false, true}) {
    base_.parts.motion.setTerms(carryTerms(half_turn));
    if (const auto way = base_.wayTo(X_base_tool(turned(this->way().front(), half_turn))))
      turns_.push_back(half_turn);
    else
      why = way.error();
  }
  if (turns_.empty()) {
    (void)base_.fail(why.code == ErrorCode::Refused ? "in_collision" : "unreachable", why.message);
    return;
  }
  // The shorter turn first.
  const Eigen::Isometry3d X_now = X_base_brick();
  if (turns_.size() == 2 && rotationAngle(X_now.inverse() * turned(request_.X_base_slot, true)) <
                                rotationAngle(X_now.inverse() * request_.X_base_slot))
    std::reverse(turns_.begin(), turns_.end());
  carry(now);
}

void PlaceBrick::cancel() {
  if (base_.running()) base_.cancel();
}

Eigen::Isometry3d PlaceBrick::X_base_brick() const {
  return base_.X_base_tool() * request_.brick.X_tool_brick;
}

Eigen::Isometry3d PlaceBrick::X_base_tool(const Eigen::Isometry3d& X_base_brick) const {
  return X_base_brick * request_.brick.X_tool_brick.inverse();
}

/// The last one is straight above the slot, away from the neighbour.
std::vector<Eigen::Isometry3d> PlaceBrick::way() const {
  if (!request_.way_base_brick.empty()) return request_.way_base_brick;
  const Eigen::Vector3d away = -request_.towards.value_or(Eigen::Vector3d::Zero());
  const auto over = [&](double up_m, double aside_m) {
    return moved(request_.X_base_slot, aside_m * away + up_m * Eigen::Vector3d::UnitZ());
  };
  return {over(config_.above_m, config_.apart_m), over(config_.near_m, config_.aside_m)};
}

/// To where the way in begins, in a posture from which it can be followed to its end.
ArmMoveTerms PlaceBrick::carryTerms(bool half_turn) const {
  std::vector<Eigen::Isometry3d> lines;
  const std::vector<Eigen::Isometry3d> in = way();
  for (std::size_t i = 1; i < in.size(); ++i)
    lines.push_back(X_base_tool(turned(in[i], half_turn)));
  const double down = in.back().translation().z() - request_.X_base_slot.translation().z();
  lines.push_back(
      X_base_tool(moved(turned(in.back(), half_turn), {0, 0, -down - config_.beyond_m})));
  ArmMoveTerms terms = base_.freelyBefore(request_.around, touchable_, lines);
  terms.keep_tilt = false;
  return terms;
}

void PlaceBrick::carry(Stamp now) {
  const Eigen::Isometry3d goal = X_base_tool(turned(way().front(), turns_.front()));
  ArmMoveTerms terms = carryTerms(turns_.front());
  terms.keep_tilt = base_.sameTilt(goal);
  base_.parts.motion.setTerms(std::move(terms));
  enter(Stage::Carrying, "carries it before its slot", now);
  entered_ = 1;
  base_.parts.motion.startPose(base_.flangeForTool(goal), now);
}

void PlaceBrick::line(Stage stage, std::string text, const Eigen::Isometry3d& X_base_brick,
                      double speed_mps, double guard_n, Stamp now) {
  enter(stage, std::move(text), now);
  base_.lineTo(base_.line(request_.around, touchable_, speed_mps, guard_n),
               X_base_tool(X_base_brick), now);
}

SkillStatus PlaceBrick::poll(Stamp now) {
  if (!base_.running() || base_.interrupted(config_.timeout_s, now)) return base_.status;
  if (stage_ == Stage::Zeroing) {
    if (base_.zeroOverdue(now))
      return base_.fail("timeout", "the force sensor cannot be zeroed: something presses on it");
    if (!base_.zeroed()) return base_.status;
    if (atTheDoor()) {
      enterNext(config_.enter_mps, config_.enter_n, now);
      return base_.status;
    }
    base_.watch.setSupported(true);
    const double down = way().back().translation().z() - request_.X_base_slot.translation().z();
    line(Stage::Lowering, "down until the support is felt",
         moved(turned(way().back(), turns_.front()), {0, 0, -down - config_.beyond_m}),
         config_.lower_mps, config_.support_n, now);
    return base_.status;
  }
  if (stage_ == Stage::Releasing) {
    if (toSeconds(now - stage_began_) >= config_.release_s) leave(now);
    return base_.status;
  }
  const SkillStatus motion = base_.parts.motion.poll(now);
  if (stage_ == Stage::Leaving) return left(motion);
  if (motion.phase == SkillPhase::Running) return base_.status;
  switch (stage_) {
    case Stage::Carrying:
    case Stage::Entering:
      return carried(motion, now);
    case Stage::Lowering:
    case Stage::SettingDown:
      return lowered(motion, now);
    case Stage::Nearing:
      return neared(motion, now);
    default:
      break;
  }
  if (motion.phase == SkillPhase::Failed) return base_.fail(motion.failure_code, motion.text);
  if (stage_ == Stage::Raising) {
    const double past = config_.aside_m + config_.side_past_m;
    line(Stage::Nearing, "sideways until the neighbour is felt",
         moved(X_base_brick(), past * *request_.towards), config_.side_mps, config_.side_n, now);
  } else {
    line(Stage::SettingDown, "sets it down", moved(X_base_brick(), {0, 0, -kReadyAbove_m}),
         config_.lower_mps, config_.support_n, now);
  }
  return base_.status;
}

SkillStatus PlaceBrick::carried(const SkillStatus& motion, Stamp now) {
  if (motion.phase == SkillPhase::Failed) {
    const bool elsewhere =
        motion.failure_code == "in_collision" || motion.failure_code == "unreachable";
    if (stage_ != Stage::Carrying || !elsewhere || turns_.size() < 2)
      return base_.fail(motion.failure_code, motion.text);
    turns_.erase(turns_.begin());
    carry(now);
    return base_.status;
  }
  if (entered_ < way().size() && !atTheDoor()) {
    const bool inside = !request_.way_base_brick.empty() && entered_ + 1 == way().size();
    if (inside)
      enterNext(config_.inside_mps, config_.enter_n, now);
    else
      enterNext(config_.leave_mps, config_.handling.guard_n, now);
    return base_.status;
  }
  enter(Stage::Zeroing, "zeroes the force sensor", now);
  base_.askZero(now);
  return base_.status;
}

/// The mouth of a bin is next: slow, and the sensor zeroed as the brick hangs now.
bool PlaceBrick::atTheDoor() const {
  return !request_.way_base_brick.empty() && entered_ + 2 == way().size();
}

void PlaceBrick::enterNext(double speed_mps, double guard_n, Stamp now) {
  line(Stage::Entering, "brings it in", turned(way()[entered_++], turns_.front()), speed_mps,
       guard_n, now);
}

SkillStatus PlaceBrick::lowered(const SkillStatus& motion, Stamp now) {
  if (motion.phase == SkillPhase::Done)
    return base_.fail(
        "no_contact",
        fmt::format("nothing carries the brick {:.0f} mm below its slot", 1e3 * config_.beyond_m));
  if (motion.failure_code != "contact") return base_.fail(motion.failure_code, motion.text);
  const double high = X_base_brick().translation().z() - request_.X_base_slot.translation().z();
  if (high > config_.early_m)
    return base_.fail("contact",
                      fmt::format("the brick met something {:.0f} mm above its slot", 1e3 * high));
  if (stage_ == Stage::Lowering && request_.towards) {
    line(Stage::Raising, "off its support", moved(X_base_brick(), {0, 0, config_.raise_m}),
         config_.lower_mps, config_.handling.guard_n, now);
  } else {
    release(now);
  }
  return base_.status;
}

/// Back by the joint from what was felt; to the slot's own place if nothing was.
SkillStatus PlaceBrick::neared(const SkillStatus& motion, Stamp now) {
  if (motion.phase == SkillPhase::Failed && motion.failure_code != "contact")
    return base_.fail(motion.failure_code, motion.text);
  neighbour_felt_ = motion.phase == SkillPhase::Failed;
  const double back = neighbour_felt_ ? config_.joint_m : config_.side_past_m;
  line(Stage::BackingOff, neighbour_felt_ ? "back by the joint" : "no neighbour: to its slot",
       moved(X_base_brick(), -back * *request_.towards), config_.lower_mps,
       config_.handling.guard_n, now);
  return base_.status;
}

void PlaceBrick::release(Stamp now) {
  enter(Stage::Releasing, "lets it go", now);
  X_base_release_ = base_.X_base_tool();
  placement_ = {base_.flangeForTool(X_base_release_), X_base_brick(), neighbour_felt_};
  base_.watch.end();
  base_.magnets(false);
  base_.letGo();
}

void PlaceBrick::leave(Stamp now) {
  const KnownBrick lies{request_.brick.name, request_.brick.kind, placement_->X_base_brick};
  std::vector<OrientedBox> around = request_.around;
  around.push_back(boxesOf({&lies, 1}).front());
  std::vector<std::string> touchable = touchable_;
  touchable.push_back(lies.name);
  enter(Stage::Leaving, "leaves it", now);
  base_.lineTo(
      base_.line(around, std::move(touchable), config_.leave_mps, config_.handling.guard_n),
      X_base_release_ * Eigen::Translation3d(0, 0, -config_.leave_m), now);
}

SkillStatus PlaceBrick::left(const SkillStatus& motion) {
  const Eigen::Vector3d away = base_.X_base_tool().translation() - X_base_release_.translation();
  if (away.norm() > config_.stuck_m && base_.contact()) {
    base_.cancel();
    return base_.fail("not_released", "the brick comes along though the magnets are off");
  }
  if (motion.phase == SkillPhase::Running) return base_.status;
  if (motion.phase == SkillPhase::Failed) return base_.fail(motion.failure_code, motion.text);
  base_.parts.motion.setTerms({});
  return base_.done("set down");
}

}  // namespace kiln
