#include "robot/skills/bricks/pick_brick.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "common/core/log.h"

namespace kiln {
namespace {

constexpr double kGoldenAngle_rad = 2.39996;  // fills a disc evenly
constexpr double kSwings_s = 0.1;             // after a motion, before anything is weighed
constexpr double kGravity_mps2 = 9.81;

Eigen::Vector2d onSpiral(int n, double step_m) {
  const double r = step_m * std::sqrt(n), angle = kGoldenAngle_rad * n;
  return {r * std::cos(angle), r * std::sin(angle)};
}

/// From the plate, along its normal.
Eigen::Translation3d away(double by_m) { return Eigen::Translation3d(0, 0, -by_m); }

}  // namespace

void PickBrick::Config::visit(ConfigArchive& a) {
  a.field("above_m", above_m, "m", 0.03, 0.5, "the face waits so far before the plate");
  a.field("beyond_m", beyond_m, "m", 0, 0.1, "led so far beyond where the plate should be");
  a.field("approach_mps", approach_mps, "m/s", 0.005, 0.1, "until something is felt");
  a.field("touch_n", touch_n, "N", 5, 60, "that counts as felt");
  a.field("switch_s", switch_s, "s", 0.1, 5, "for the contact switch to close");
  a.field("grip_s", grip_s, "s", 0.05, 5, "closed for so long before it is lifted");
  a.field("check_lift_m", check_lift_m, "m", 0.005, 0.1, "lifted so far to be weighed");
  a.field("lift_m", lift_m, "m", 0.02, 0.6, "and so far in the end");
  a.field("lift_mps", lift_mps, "m/s", 0.01, 0.3, "slowly");
  a.field("weigh_s", weigh_s, "s", 0.1, 3, "at rest");
  a.field("weight_tolerance", weight_tolerance, "", 0.05, 0.9, "share of the weight");
  a.field("max_tries", max_tries, "", 1, 20, "with an offset each");
  a.field("spiral_m", spiral_m, "m", 0, 0.05, "between neighbours on the spiral");
  a.field("timeout_s", timeout_s, "s", 5, 600, "of all tries");
  a.section("handling", handling, "motion near bricks and with one");
}

PickBrick::PickBrick(Config config, HandlingParts parts)
    : config_(std::move(config)), base_(config_.handling, parts) {}

void PickBrick::start(PickRequest request, Stamp now) {
  request_ = std::move(request);
  held_.reset();
  try_ = 0;
  base_.letGo();
  base_.begin("to the brick", now);
  const OrientedBox own = boxesOf({&request_.brick, 1}).front();
  std::erase_if(request_.around, [&](const OrientedBox& box) { return box.name == own.name; });
  request_.around.push_back(own);
  touchable_ = touchedBy(own, request_.around, config_.handling.touching_m);
  goAbove(now);
}

void PickBrick::cancel() {
  if (base_.running()) base_.cancel();
}

void PickBrick::enter(Stage stage, std::string text, Stamp now) {
  stage_ = stage;
  stage_began_ = now;
  base_.status.text = std::move(text);
}

/// The face's place on the plate, so far away along its normal.
Eigen::Isometry3d PickBrick::before(double away_m) const {
  return candidates_.front() * away(away_m);
}

/// To before the plate, in a posture from which all that follows is done on straight lines.
ArmMoveTerms PickBrick::aboveTerms(const Eigen::Isometry3d& X_base_tool) const {
  const Eigen::Vector3d along = request_.lift.value_or(-X_base_tool.linear().col(2));
  const Eigen::Isometry3d up = Eigen::Translation3d(config_.lift_m * along) * X_base_tool;
  return base_.freelyBefore(request_.around, touchable_,
                            {X_base_tool * away(-config_.beyond_m), up, up * away(request_.out_m)});
}

/// The face, with the brick on it.
Eigen::Isometry3d PickBrick::lifted(double by_m) const {
  const Eigen::Vector3d along = request_.lift.value_or(-X_base_grip_.linear().col(2));
  return Eigen::Translation3d(by_m * along) * X_base_grip_;
}

ArmMoveTerms PickBrick::lineTerms(double speed_mps, double guard_n) const {
  return base_.line(request_.around, touchable_, speed_mps, guard_n);
}

void PickBrick::goAbove(Stamp now) {
  const Eigen::Vector2d offset = onSpiral(try_, config_.spiral_m);
  std::vector<std::pair<double, Eigen::Isometry3d>> found;
  Error why;
  for (const bool half_turn : {false, true}) {
    const Eigen::Isometry3d X = request_.brick.X_frame_brick * X_brick_face(offset, half_turn);
    base_.parts.motion.setTerms(aboveTerms(X));
    if (const auto way = base_.wayTo(X * away(config_.above_m)))
      found.emplace_back(*way, X);
    else
      why = way.error();
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  candidates_.clear();
  for (const auto& [way, X] : found) candidates_.push_back(X);
  if (candidates_.empty()) {
    (void)base_.fail(why.code == ErrorCode::Refused ? "in_collision" : "unreachable", why.message);
    return;
  }
  startAbove(now);
}

void PickBrick::startAbove(Stamp now) {
  enter(Stage::Above, fmt::format("to the brick, try {}", tries()), now);
  base_.parts.motion.setTerms(aboveTerms(candidates_.front()));
  base_.parts.motion.startPose(base_.flangeForTool(before(config_.above_m)), now);
}

SkillStatus PickBrick::poll(Stamp now) {
  if (!base_.running() || base_.interrupted(config_.timeout_s, now)) {
    if (base_.drop) held_.reset();
    return base_.status;
  }
  if (stage_ == Stage::Zeroing) {
    if (base_.zeroOverdue(now))
      return base_.fail("timeout", "the force sensor cannot be zeroed: something presses on it");
    if (!base_.zeroed()) return base_.status;
    enter(Stage::Approaching, "down until something is felt", now);
    base_.lineTo(lineTerms(config_.approach_mps, config_.touch_n), before(-config_.beyond_m), now);
    return base_.status;
  }
  if (stage_ == Stage::Gripping) return grip(now);
  if (stage_ == Stage::Weighing) return weigh(now);
  const SkillStatus motion = base_.parts.motion.poll(now);
  if (motion.phase == SkillPhase::Running) return base_.status;
  const bool met = motion.failure_code == "contact";
  switch (stage_) {
    case Stage::Above:
      return nextPose(motion, now);
    case Stage::Approaching:
      return approached(motion, now);
    case Stage::LiftingABit:
      if (met) break;  // weighed will be what it does not lift
      [[fallthrough]];
    case Stage::Lifting:
      if (motion.phase == SkillPhase::Failed) return base_.fail(motion.failure_code, motion.text);
      if (stage_ == Stage::Lifting) {
        base_.parts.motion.setTerms(base_.freely({}));
        return base_.done(fmt::format("{} held, {:.2f} kg", held_->name, held_->weighed_kg));
      }
      break;
    case Stage::LayingBack:
      if (motion.phase == SkillPhase::Failed && !met)
        return base_.fail(motion.failure_code, motion.text);
      return again("not_held", failed_text_, now);
    case Stage::Withdrawing:
      if (motion.phase == SkillPhase::Failed) return base_.fail(motion.failure_code, motion.text);
      return withdrawn(now);
    default:
      break;
  }
  enter(Stage::Weighing, "weighs it", now);
  weight_sum_n_ = 0.0;
  weight_samples_ = 0;
  return base_.status;
}

/// There, or the other half turn.
SkillStatus PickBrick::nextPose(const SkillStatus& motion, Stamp now) {
  if (motion.phase == SkillPhase::Failed) {
    const bool elsewhere =
        motion.failure_code == "in_collision" || motion.failure_code == "unreachable";
    if (!elsewhere || candidates_.size() < 2) return base_.fail(motion.failure_code, motion.text);
    candidates_.erase(candidates_.begin());
    startAbove(now);
    return base_.status;
  }
  enter(Stage::Zeroing, "zeroes the force sensor", now);
  base_.askZero(now);
  return base_.status;
}

SkillStatus PickBrick::approached(const SkillStatus& motion, Stamp now) {
  if (motion.phase == SkillPhase::Done)
    return again("no_contact", "nothing was felt where the plate should be", now);
  if (motion.failure_code != "contact") return base_.fail(motion.failure_code, motion.text);
  enter(Stage::Gripping, "magnets on", now);
  base_.magnets(true);
  closed_since_.reset();
  return base_.status;
}

SkillStatus PickBrick::grip(Stamp now) {
  if (!base_.contact()) closed_since_.reset();
  if (base_.contact() && !closed_since_) closed_since_ = now;
  if (closed_since_ && toSeconds(now - *closed_since_) >= config_.grip_s) {
    X_base_grip_ = base_.X_base_tool();
    base_.tellOf(asGripped());
    enter(Stage::LiftingABit, "lifts it a little", now);
    base_.lineTo(lineTerms(0.5 * config_.lift_mps, config_.handling.guard_n),
                 lifted(config_.check_lift_m), now);
    return base_.status;
  }
  if (toSeconds(now - stage_began_) > config_.switch_s)
    return again("no_contact", "something was felt, but the contact switch does not close", now);
  return base_.status;
}

/// Flush on the face, turned as it lay.
HeldBrick PickBrick::asGripped() const {
  const Eigen::Isometry3d X = base_.X_base_tool().inverse() * request_.brick.X_frame_brick;
  HeldBrick out{request_.brick.name, request_.brick.kind, {}, 0.0};
  out.X_tool_brick =
      Eigen::Translation3d(X.translation().x(), X.translation().y(), 0.5 * kBrickSide_m) *
      Eigen::AngleAxisd(std::atan2(X.linear()(1, 0), X.linear()(0, 0)), Eigen::Vector3d::UnitZ()) *
      Eigen::AngleAxisd(M_PI, Eigen::Vector3d::UnitX());
  return out;
}

SkillStatus PickBrick::weigh(Stamp now) {
  const double rested_s = toSeconds(now - stage_began_);
  if (rested_s < kSwings_s) return base_.status;
  if (const auto up = base_.upForce()) {
    weight_sum_n_ += *up;
    ++weight_samples_;
  }
  if (rested_s < kSwings_s + config_.weigh_s) return base_.status;
  const double missing_n = weight_samples_ > 0 ? weight_sum_n_ / weight_samples_ : INFINITY;
  HeldBrick brick = *base_.brick;
  brick.weighed_kg = brick.mass_kg() - missing_n / kGravity_mps2;
  const bool heavy = std::abs(missing_n) <= config_.weight_tolerance * brick.weight_n();
  if (base_.contact() && heavy) {
    held_ = brick;
    base_.hold(brick, now);
    enter(Stage::Lifting, "lifts it", now);
    const Eigen::Isometry3d up = lifted(config_.lift_m);
    base_.lineTo(lineTerms(config_.lift_mps, config_.handling.guard_n),
                 {up, up * Eigen::Translation3d(0, 0, -request_.out_m)}, now);
    return base_.status;
  }
  failed_text_ = fmt::format("{:.2f} kg hang on the face, and the contact switch is {}",
                             brick.weighed_kg, base_.contact() ? "closed" : "open");
  if (!base_.contact()) return again("not_held", failed_text_, now);
  // What hangs askew is laid back, not let fall.
  enter(Stage::LayingBack, "lays it back", now);
  base_.lineTo(lineTerms(0.5 * config_.lift_mps, config_.touch_n), X_base_grip_, now);
  return base_.status;
}

SkillStatus PickBrick::again(const char* code, std::string text, Stamp now) {
  failed_code_ = code;
  failed_text_ = std::move(text);
  base_.magnets(false);
  base_.letGo();
  logger("pick")->info("{}, try {}: {}", request_.brick.name, tries(), failed_text_);
  enter(Stage::Withdrawing, failed_text_, now);
  base_.lineTo(lineTerms(config_.lift_mps, config_.handling.guard_n), before(config_.above_m), now);
  return base_.status;
}

SkillStatus PickBrick::withdrawn(Stamp now) {
  if (++try_ < config_.max_tries) {
    goAbove(now);
    return base_.status;
  }
  --try_;
  return base_.fail(failed_code_, fmt::format("{} (after {} tries)", failed_text_, tries()));
}

}  // namespace kiln
