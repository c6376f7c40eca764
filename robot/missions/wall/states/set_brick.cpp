#include "robot/missions/wall/states/set_brick.h"

#include <fmt/format.h>

#include "robot/missions/wall/states/drive_to_wall.h"
#include "robot/missions/wall/states/locate_wall.h"
#include "robot/missions/wall/states/store_brick.h"
#include "robot/missions/wall/states/take_out_brick.h"
#include "robot/missions/wall/states/wall_built.h"
#include "robot/missions/wall/states/wall_given_up.h"

namespace kiln {

void SetBrick::enter() {
  WallContext& c = context();
  drawing_back_ = false;
  away_ = !c.hands || !c.belief.held || !c.unloading() || !c.standsAt(c.buildingPose());
  if (away_) return;
  c.handleBricks();
  const Eigen::Isometry3d X_base_wall = toIsometry(inverse(c.parts.pose()) * c.X_map_wall());
  std::optional<Eigen::Vector3d> towards = c.towardsNeighbour();
  if (towards) towards = X_base_wall.linear() * *towards;
  c.hands->set.start({*c.belief.held, X_base_wall * c.X_wall_slot(), c.aroundHands(), towards, {}},
                     now());
}

Transition SetBrick::execute() {
  const WallContext& c = context();
  if (!c.belief.held) return transit<TakeOutBrick>().because("no brick hangs on the gripper");
  if (away_) return transit<StoreBrick>().because("it is set from elsewhere");
  return drawing_back_ ? drawBack() : pollSet();
}

Transition SetBrick::pollSet() {
  WallContext& c = context();
  const SkillStatus set = c.hands->set.poll(now());
  display(c.belief.held->name + ": " + set.text);
  if (set.phase == SkillPhase::Failed) {
    if (c.hands->set.placement()) return transit<WallGivenUp>().because(set.text);
    if (c.hands->set.drop()) {
      c.belief.held.reset();
      return transit<WallGivenUp>().because("a brick that is needed next is lost: " + set.text);
    }
    met_ = set.text;
    drawing_back_ = true;
    c.parts.arm.startBack(c.config.building.back_s, now());
    return stay();
  }
  if (set.phase != SkillPhase::Done) return stay();
  const Eigen::Isometry3d X_map_base = toIsometry(c.parts.pose());
  c.belief.built.push_back(toIsometry(c.X_map_wall()).inverse() * X_map_base *
                           c.hands->set.placement()->X_base_brick);
  const std::string name = c.belief.held->name;
  c.belief.held.reset();
  c.belief.handling_faults = 0;
  const std::string how_far =
      fmt::format("{} is set, {} of {}", name, c.belief.built.size(), c.load().slots.size());
  if (c.isBuilt()) return transit<WallBuilt>().because(how_far);
  if (c.standsAt(c.buildingPose())) return transit<TakeOutBrick>().because(how_far);
  return transit<DriveToWall>().because(how_far);
}

/// Away from what it met, where it came from.
Transition SetBrick::drawBack() {
  WallContext& c = context();
  const SkillStatus back = c.parts.arm.poll(now());
  display(c.belief.held->name + " is drawn back: " + met_);
  if (back.phase == SkillPhase::Failed) return failed(met_ + "; and back: " + back.text);
  if (back.phase != SkillPhase::Done) return stay();
  return failed(met_);
}

Transition SetBrick::failed(const std::string& why) {
  WallContext& c = context();
  if (++c.belief.handling_faults > c.config.building.max_faults)
    return transit<WallGivenUp>().because("a brick cannot be set: " + why);
  return transit<SetBrick>().because("once more: " + why);
}

}  // namespace kiln
