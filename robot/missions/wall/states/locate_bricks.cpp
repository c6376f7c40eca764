#include "robot/missions/wall/states/locate_bricks.h"

#include <algorithm>

#include <fmt/format.h>

#include "robot/missions/wall/states/drive_to_marker.h"
#include "robot/missions/wall/states/drive_to_pile.h"
#include "robot/missions/wall/states/wall_given_up.h"

namespace kiln {

void LocateBricks::enter() {
  WallContext& c = context();
  asked_ = false;
  c.look.start(c.expectedBricks(), now());
}

Transition LocateBricks::execute() {
  WallContext& c = context();
  if (!c.belief.pile) return transit<DriveToPile>().because("the pile was not found yet");
  if (asked_) {
    c.bricks.tick();
    if (!c.bricks.answer()) return stay();
    const Result<BrickSight> sight = *c.bricks.answer();
    return sight ? conclude(*sight) : again(sight.error().message);
  }
  const SkillStatus look = c.look.poll(now());
  display("looking at the bricks: " + look.text);
  if (look.phase == SkillPhase::Failed) return again(look.text);
  if (look.phase != SkillPhase::Done) return stay();
  asked_ = true;
  c.askForBricks(c.look.sweep());
  return stay();
}

Transition LocateBricks::conclude(const BrickSight& sight) {
  WallContext& c = context();
  const Eigen::Isometry3d X_map_base = toIsometry(c.parts.pose());
  c.belief.bricks.clear();
  for (const BrickEstimate& brick : sight.bricks.bricks)
    c.belief.bricks.push_back(
        {brick.kind, brick.state, X_map_base * brick.X_base_brick, brick.confidence});
  const auto trusted =
      std::count_if(c.belief.bricks.begin(), c.belief.bricks.end(),
                    [&](const PileBrick& b) { return b.confidence > c.config.brick_look.trusted; });
  if (trusted == 0) return again("not one of the bricks was seen well enough");
  c.belief.pile->X_map_frame = projectToGround(X_map_base * sight.target.X_base_target);
  c.siteMoved();
  return transit<DriveToMarker>().because(
      fmt::format("{} of {} bricks found", trusted, c.belief.bricks.size()));
}

Transition LocateBricks::again(const std::string& why) {
  const WallContext& c = context();
  if (c.belief.pile_looks < c.config.pile_look.max_looks)
    return transit<DriveToPile>().because("not found: " + why);
  return transit<WallGivenUp>().because(
      fmt::format("the bricks were not found in {} looks: {}", c.belief.brick_looks, why));
}

}  // namespace kiln
