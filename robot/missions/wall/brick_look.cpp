#include "robot/missions/wall/brick_look.h"

namespace kiln {

BrickLook::BrickLook(SweepLook& look, const BrickPerception::Config& config, double latency_s,
                     Executor& executor)
    : look_(look), config_(config), question_(executor, "bricks", latency_s) {}

void BrickLook::start(const ExpectedBricks& expected, std::vector<OrientedBox> on_base) {
  question_.clear();
  asked_ = false;
  target_ = expected.target;
  look_.start(expected, std::move(on_base));
}

SkillStatus BrickLook::poll(Stamp now) {
  if (!asked_) {
    const SkillStatus sweeps = look_.poll(now);
    if (sweeps.phase != SkillPhase::Done) return sweeps;
    asked_ = true;
    question_.ask(
        [config = config_, sweep = look_.sweep(), target = target_]() -> Result<BrickSight> {
          return BrickPerception(config).perceive(*sweep, target);
        });
  }
  question_.tick();
  if (!question_.answer()) return {SkillPhase::Running, 1.0, "evaluating the sweep", ""};
  const Result<BrickSight>& seen = *question_.answer();
  if (!seen) return {SkillPhase::Failed, 1.0, seen.error().message, "not_seen"};
  return {SkillPhase::Done, 1.0, "evaluated", ""};
}

void BrickLook::cancel() {
  look_.cancel();
  question_.clear();
  asked_ = false;
}

}  // namespace kiln
