#include "robot/missions/wall/states/take_out_brick.h"

#include <fmt/format.h>

#include "robot/missions/wall/states/drive_to_wall.h"
#include "robot/missions/wall/states/set_brick.h"
#include "robot/missions/wall/states/wall_built.h"
#include "robot/missions/wall/states/wall_given_up.h"

namespace kiln {

void TakeOutBrick::enter() {
  WallContext& c = context();
  stage_ = Stage::Choosing;
  tried_ = 0;
  postures_.clear();
  if (c.isBuilt() || !c.hands) return;
  step_ = c.nextOut();
  postures_ = c.posturesFor(step_);
  brick_ = {fmt::format("brick {} of the wall", step_.brick + 1),
            c.load().storage.sequence[step_.brick], Eigen::Isometry3d::Identity()};
  c.handleBricks();
}

Transition TakeOutBrick::execute() {
  const WallContext& c = context();
  if (c.isBuilt()) return transit<WallBuilt>().because("every brick is set");
  if (!c.hands || c.belief.stored <= c.belief.built.size())
    return transit<WallGivenUp>().because("the storage is empty");
  if (stage_ == Stage::Choosing && !c.standsAt(c.buildingPose()))
    return transit<DriveToWall>().because("the base stands elsewhere");
  switch (stage_) {
    case Stage::Choosing:
      return choosePosture();
    case Stage::Travelling:
      return pollTravel();
    case Stage::Taking:
      return pollTake();
  }
  return stay();
}

/// One a tick: where the compartment has to stand for the arm to reach the bin.
Transition TakeOutBrick::choosePosture() {
  WallContext& c = context();
  const HeldBrick as_held{brick_.name, brick_.kind, X_brick_face({0, 0}, false).inverse(), 0.0};
  const auto reached = c.checkSeat(step_, postures_[tried_], as_held);
  if (reached) {
    stage_ = Stage::Travelling;
    c.hands->travel.start(postures_[tried_], now());
    return stay();
  }
  if (++tried_ < postures_.size()) return stay();
  return failed("its bin is out of the arm's reach: " + reached.error().message);
}

Transition TakeOutBrick::pollTravel() {
  WallContext& c = context();
  const SkillStatus travel = c.hands->travel.poll(now());
  display(brick_.name + ": " + travel.text);
  if (travel.phase == SkillPhase::Failed) return failed(travel.text);
  if (travel.phase != SkillPhase::Done) return stay();
  stage_ = Stage::Taking;
  const Eigen::Isometry3d X_seat = c.X_base_seat(step_, postures_[tried_]);
  brick_.X_frame_brick = X_seat;
  std::vector<OrientedBox> around = c.aroundHands();
  const OrientedBox itself = boxesOf({&brick_, 1}).front();
  std::erase_if(around, [&](const OrientedBox& box) {
    return (box.X_frame_box.translation() - itself.X_frame_box.translation()).norm() < 1e-6;
  });
  c.hands->take_out.start(
      {brick_, std::move(around), X_seat.linear().col(0).eval(), c.config.building.out_m}, now());
  return stay();
}

Transition TakeOutBrick::pollTake() {
  WallContext& c = context();
  const SkillStatus take = c.hands->take_out.poll(now());
  display(brick_.name + ": " + take.text);
  if (take.phase == SkillPhase::Done) {
    c.belief.held = *c.hands->take_out.held();
    ++c.belief.taken_out;
    c.belief.handling_faults = 0;
    return transit<SetBrick>().because(brick_.name + " hangs on the gripper");
  }
  if (take.phase != SkillPhase::Failed) return stay();
  if (c.hands->take_out.drop()) {
    ++c.belief.taken_out;
    return transit<WallGivenUp>().because("a brick that is needed next is lost: " + take.text);
  }
  return failed(take.text);
}

Transition TakeOutBrick::failed(const std::string& why) {
  WallContext& c = context();
  if (++c.belief.handling_faults > c.config.building.max_faults)
    return transit<WallGivenUp>().because(brick_.name + " cannot be taken out: " + why);
  return transit<TakeOutBrick>().because("once more: " + why);
}

}  // namespace kiln
