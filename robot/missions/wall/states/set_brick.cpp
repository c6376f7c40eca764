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
  away_ = !c.hands || !c.belief.held || !c.belief.unloading() || !c.belief.wall ||
          !c.standsAt(c.buildingPose());
  if (away_) return;
  c.handleBricks();
  // The arm holds meanwhile, with what hangs on it.
  c.parts.arm_control->carry(c.belief.held->payload(c.parts.robot));
  stage_ = Stage::LeavingBin;
  if (!exit_.start(c, now())) beginSet();
}

void SetBrick::beginSet() {
  WallContext& c = context();
  stage_ = Stage::Setting;
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
  switch (stage_) {
    case Stage::LeavingBin:
      return leaveBin();
    case Stage::Setting:
      return pollSet();
    case Stage::DrawingBack:
      return drawBack();
  }
  return stay();
}

/// After an interruption: it still stands where it was taken from.
Transition SetBrick::leaveBin() {
  const SkillStatus out = exit_.poll(now());
  display(context().belief.held->name + " is led out of the storage: " + out.text);
  if (out.phase == SkillPhase::Failed) return failed("not out of the storage: " + out.text);
  if (out.phase == SkillPhase::Done) beginSet();
  return stay();
}

Transition SetBrick::pollSet() {
  WallContext& c = context();
  const SkillStatus set = c.hands->set.poll(now());
  display(c.belief.held->name + ": " + set.text);
  if (set.phase == SkillPhase::Failed) {
    if (c.hands->set.hasLetGo()) return placed(set.text);
    if (c.hands->set.drop()) {
      c.belief.held.reset();
      return transit<WallGivenUp>().because("a brick that is needed next is lost: " + set.text);
    }
    met_ = set.text;
    stage_ = Stage::DrawingBack;
    c.parts.arm.startBack(c.config.building.back_s, now());
    return stay();
  }
  if (set.phase != SkillPhase::Done) return stay();
  return placed("");
}

Transition SetBrick::placed(const std::string& after) {
  WallContext& c = context();
  const Eigen::Isometry3d X_map_base = toIsometry(c.parts.pose());
  c.belief.built.push_back(toIsometry(c.X_map_wall()).inverse() * X_map_base *
                           c.hands->set.placement()->X_base_brick);
  std::string name = c.belief.held->name;
  if (!after.empty()) name += " (" + after + ")";
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
