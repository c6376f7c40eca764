#include "robot/missions/wall/states/locate_bricks.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "common/core/log.h"
#include "common/core/units.h"
#include "robot/missions/wall/pile_bricks.h"
#include "robot/missions/wall/states/approach_stack.h"
#include "robot/missions/wall/states/drive_to_marker.h"
#include "robot/missions/wall/states/drive_to_pile.h"
#include "robot/missions/wall/states/drive_to_stack.h"
#include "robot/missions/wall/states/take_brick.h"
#include "robot/missions/wall/states/wall_given_up.h"

namespace kiln {
namespace {

/// A brick that stands on the ground on which the robot stands: what the sweep says of its tilt is
/// the mounting of the LiDAR, and a face that is not flush does not hold.
Eigen::Isometry3d levelled(const Eigen::Isometry3d& X_base_brick, double within_rad) {
  const double tilt = std::acos(std::clamp(X_base_brick.linear()(2, 2), -1.0, 1.0));
  if (tilt > within_rad) return X_base_brick;
  return makePose(X_base_brick.translation(), {0.0, 0.0, projectToGround(X_base_brick).yaw_rad});
}

}  // namespace

void LocateBricks::enter() {
  WallContext& c = context();
  c.brick_look.start(c.expectedBricks(), c.storageNow());
}

Transition LocateBricks::execute() {
  WallContext& c = context();
  if (!c.belief.pile) return transit<DriveToPile>().because("the pile was not found yet");
  const SkillStatus look = c.brick_look.poll(now());
  display("looking at the bricks: " + look.text);
  if (look.phase == SkillPhase::Failed) return again(look.text);
  if (look.phase != SkillPhase::Done) return stay();
  return conclude(c.brick_look.sight());
}

Transition LocateBricks::conclude(const BrickSight& sight) {
  WallContext& c = context();
  const BrickLookConfig& config = c.config.brick_look;
  const Eigen::Isometry3d X_map_base = toIsometry(c.parts.pose());
  std::vector<PileBrick> seen;
  for (const BrickEstimate& brick : sight.bricks.bricks) {
    seen.resize(std::max(seen.size(), static_cast<std::size_t>(brick.id) + 1));
    seen[static_cast<std::size_t>(brick.id)] = {
        brick.kind,
        brick.state,
        X_map_base * levelled(brick.X_base_brick, config.level_deg * kDeg),
        brick.confidence,
        false,
        alongSigma(brick)};
  }
  c.belief.bricks = merged(c.belief.bricks, seen, config.trusted, c.stoodSincePileLook());
  c.pile_looked_from = c.parts.pose();
  c.belief.pile->X_map_frame = projectToGround(X_map_base * sight.target.X_base_target);
  c.siteMoved();
  int trusted = 0;
  for (std::size_t i = 0; i < c.belief.bricks.size(); ++i) {
    const PileBrick& brick = c.belief.bricks[i];
    if (brick.taken) continue;
    if (brick.confidence > config.trusted)
      ++trusted;
    else
      logger("wall")->info("brick {}, {}: {}, {:.0f} %", i + 1, brickShape(brick.kind).name,
                           toString(brick.state), 100.0 * brick.confidence);
  }
  if (trusted == 0) return again("not one of the bricks was seen well enough");
  return goOn(fmt::format("{} bricks found", trusted));
}

Transition LocateBricks::goOn(const std::string& found) {
  const WallContext& c = context();
  if (!c.hands || c.loaded()) return transit<DriveToMarker>().because(found);
  const auto next = c.nextBrick();
  if (!next) return again(found + ", but none that can be taken next");
  if (c.standsAt(c.takingPose(*next))) return transit<TakeBrick>().because(found);
  if (c.standsAt(c.stackLookPose(*next))) return transit<ApproachStack>().because(found);
  return transit<DriveToStack>().because(found);
}

Transition LocateBricks::again(const std::string& why) {
  WallContext& c = context();
  if (c.anyTaken()) {  // no pile any more that could be found as a whole
    if (++c.belief.handling_faults > c.config.loading.max_faults)
      return transit<WallGivenUp>().because("the bricks that are left are not found: " + why);
    if (c.nextBrick()) return transit<DriveToStack>().because("once more: " + why);
    return transit<DriveToPile>().because("once more: " + why);
  }
  if (c.belief.pile_looks < c.config.pile_look.max_looks)
    return transit<DriveToPile>().because("not found: " + why);
  return transit<WallGivenUp>().because(
      fmt::format("the bricks were not found in {} looks: {}", c.belief.brick_looks, why));
}

}  // namespace kiln
