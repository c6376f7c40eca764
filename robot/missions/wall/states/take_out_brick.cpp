#include "robot/missions/wall/states/take_out_brick.h"

#include <fmt/format.h>

#include "robot/missions/wall/states/drive_to_wall.h"
#include "robot/missions/wall/states/set_brick.h"
#include "robot/missions/wall/states/wall_built.h"
#include "robot/missions/wall/states/wall_given_up.h"

namespace kiln {

void TakeOutBrick::enter() {
  WallContext& c = context();
  stage_ = Stage::ReachingBin;
  hangs_ = false;
  if (c.isBuilt() || !c.hands || !c.belief.wall) return;
  const StorageStep& step = c.nextOut();
  brick_ = {fmt::format("brick {} of the wall", step.brick + 1),
            c.load().storage.sequence[step.brick], Eigen::Isometry3d::Identity()};
  c.handleBricks();
  // Gripped before an interruption: where on the face is not known, but within what is allowed.
  hangs_ = c.somethingHangs();
  bin_.start(c, step, {brick_.name, brick_.kind, X_brick_face({0, 0}, false).inverse(), 0.0});
}

Transition TakeOutBrick::execute() {
  const WallContext& c = context();
  if (c.isBuilt()) return transit<WallBuilt>().because("every brick is set");
  if (stage_ == Stage::ReachingBin) {
    if (c.belief.unloading())
      return transit<WallGivenUp>().because("the brick that is needed next is lost");
    if (!c.hands || !c.inStorage(c.nextOut().brick))
      return transit<WallGivenUp>().because("the brick that is needed next is not in the storage");
    if (!c.belief.wall || !c.standsAt(c.buildingPose()))
      return transit<DriveToWall>().because("the base stands elsewhere");
    if (hangs_)
      return taken({brick_.name, brick_.kind, X_brick_face({0, 0}, false).inverse(), 0.0});
  }
  return stage_ == Stage::ReachingBin ? reachBin() : pollTake();
}

Transition TakeOutBrick::reachBin() {
  WallContext& c = context();
  const SkillStatus bin = bin_.poll(now());
  display(brick_.name + ": " + bin.text);
  if (bin.phase == SkillPhase::Failed) return failed(bin.text);
  if (bin.phase != SkillPhase::Done) return stay();
  stage_ = Stage::Taking;
  brick_.X_frame_brick = c.X_base_seat(bin_.step(), bin_.posture());
  std::vector<OrientedBox> around = c.aroundHands();
  const Eigen::Vector3d place = brick_.X_frame_brick.translation();
  std::erase_if(around, [&](const OrientedBox& box) {  // itself
    return (box.X_frame_box.translation() - place).norm() < 1e-6;
  });
  const Eigen::Vector3d up = brick_.X_frame_brick.linear().col(0);
  c.hands->take_out.start({brick_, std::move(around), up, c.config.building.out_m}, now());
  return stay();
}

Transition TakeOutBrick::pollTake() {
  WallContext& c = context();
  const SkillStatus take = c.hands->take_out.poll(now());
  display(brick_.name + ": " + take.text);
  if (take.phase == SkillPhase::Done) return taken(*c.hands->take_out.held());
  if (take.phase != SkillPhase::Failed) return stay();
  if (c.hands->take_out.drop()) {
    ++c.belief.taken_out;
    return transit<WallGivenUp>().because("a brick that is needed next is lost: " + take.text);
  }
  const bool from_elsewhere =
      take.failure_code == "in_collision" || take.failure_code == "unreachable";
  if (from_elsewhere && bin_.tryNext()) {
    stage_ = Stage::ReachingBin;
    return stay();
  }
  return failed(take.text);
}

Transition TakeOutBrick::taken(HeldBrick held) {
  WallBelief& belief = context().belief;
  belief.held = std::move(held);
  ++belief.taken_out;
  belief.handling_faults = 0;
  return transit<SetBrick>().because(brick_.name + " hangs on the gripper");
}

Transition TakeOutBrick::failed(const std::string& why) {
  WallContext& c = context();
  if (++c.belief.handling_faults > c.config.building.max_faults)
    return transit<WallGivenUp>().because(brick_.name + " cannot be taken out: " + why);
  return transit<TakeOutBrick>().because("once more: " + why);
}

}  // namespace kiln
