#include "robot/missions/wall/states/take_brick.h"

#include "robot/missions/wall/states/drive_to_stack.h"
#include "robot/missions/wall/states/locate_bricks.h"
#include "robot/missions/wall/states/store_brick.h"
#include "robot/missions/wall/states/wall_given_up.h"

namespace kiln {

void TakeBrick::enter() {
  WallContext& c = context();
  brick_ = c.nextBrick();
  hangs_ = false;
  if (!brick_ || !c.hands) return;
  hangs_ = c.somethingHangs();
  if (hangs_) return;
  c.handleBricks();
  c.hands->pick.start({c.knownBrick(*brick_), c.aroundHands(), std::nullopt, 0.0}, now());
}

Transition TakeBrick::execute() {
  WallContext& c = context();
  if (!brick_) return transit<LocateBricks>().because("it is not known what to take");
  const KnownBrick brick = c.knownBrick(*brick_);
  // Where on the face is not known, but within what the approach allows.
  if (hangs_) return taken({brick.name, brick.kind, X_brick_face({0, 0}, false).inverse(), 0.0});
  const SkillStatus pick = c.hands->pick.poll(now());
  display(brick.name + ": " + pick.text);
  if (pick.phase == SkillPhase::Done) return taken(*c.hands->pick.held());
  if (pick.phase != SkillPhase::Failed) return stay();
  if (c.hands->pick.drop()) c.belief.bricks[*brick_].taken = true;  // and lies somewhere
  if (++c.belief.handling_faults > c.config.loading.max_faults)
    return transit<WallGivenUp>().because(brick.name + " cannot be taken: " + pick.text);
  return transit<DriveToStack>().because(brick.name + " was not taken: " + pick.text);
}

Transition TakeBrick::taken(HeldBrick held) {
  WallBelief& belief = context().belief;
  const std::string name = held.name;
  belief.held = std::move(held);
  belief.bricks[*brick_].taken = true;
  return transit<StoreBrick>().because(name + " hangs on the gripper");
}

}  // namespace kiln
