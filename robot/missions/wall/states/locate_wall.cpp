#include "robot/missions/wall/states/locate_wall.h"

#include <cmath>

#include <fmt/format.h>

#include "common/core/units.h"
#include "robot/missions/wall/pile_bricks.h"
#include "robot/missions/wall/states/drive_to_wall.h"
#include "robot/missions/wall/states/take_out_brick.h"
#include "robot/missions/wall/states/wall_given_up.h"

namespace kiln {

void LocateWall::enter() {
  WallContext& c = context();
  if (c.belief.wall && !c.belief.built.empty())
    c.brick_look.start(c.expectedWall(), c.storageNow());
}

Transition LocateWall::execute() {
  WallContext& c = context();
  if (!c.belief.wall) return transit<DriveToWall>().because("the marker was not found yet");
  if (c.belief.built.empty()) return transit<TakeOutBrick>().because("nothing was built yet");
  const SkillStatus look = c.brick_look.poll(now());
  display("looking at the wall: " + look.text);
  if (look.phase == SkillPhase::Failed) return again(look.text);
  if (look.phase != SkillPhase::Done) return stay();
  return conclude(c.brick_look.sight());
}

/// All bricks that are seen well say together how far the base erred on its way.
Transition LocateWall::conclude(const BrickSight& sight) {
  WallContext& c = context();
  const double trusted = c.config.brick_look.trusted;
  const Eigen::Isometry3d X_map_base = toIsometry(c.parts.pose());
  const Eigen::Isometry3d X_map_wall = toIsometry(c.X_map_wall());
  std::vector<PileBrick> before, seen;
  int found = 0;
  for (const BrickEstimate& brick : sight.bricks.bricks) {
    const Eigen::Isometry3d& X_wall_brick = c.belief.built[static_cast<std::size_t>(brick.id)];
    before.push_back({brick.kind, BrickState::Found, X_map_wall * X_wall_brick, 1.0, false});
    seen.push_back({brick.kind, brick.state, X_map_base * brick.X_base_brick, brick.confidence,
                    false, alongSigma(brick)});
    if (brick.confidence > trusted) ++found;
  }
  if (found == 0) return again("not one of its bricks was seen well enough");
  const Pose2 moved = projectToGround(commonMotion(before, seen, trusted).X);
  c.belief.wall->X_map_frame = moved * c.belief.wall->X_map_frame;
  c.belief.handling_faults = 0;
  c.siteMoved();
  return transit<TakeOutBrick>().because(
      fmt::format("{} of {} bricks seen; the wall is {:.1f} cm and {:.1f} deg from where it was "
                  "believed to be",
                  found, c.belief.built.size(),
                  100.0 * std::hypot(c.belief.wall->X_map_frame.x_m - X_map_wall.translation().x(),
                                     c.belief.wall->X_map_frame.y_m - X_map_wall.translation().y()),
                  moved.yaw_rad / kDeg));
}

Transition LocateWall::again(const std::string& why) {
  WallContext& c = context();
  if (++c.belief.handling_faults <= c.config.building.max_faults)
    return transit<LocateWall>().because("once more: " + why);
  return transit<WallGivenUp>().because("the wall is not seen: " + why);
}

}  // namespace kiln
