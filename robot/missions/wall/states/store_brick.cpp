#include "robot/missions/wall/states/store_brick.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "common/core/log.h"
#include "common/core/units.h"
#include "robot/missions/wall/states/drive_to_marker.h"
#include "robot/missions/wall/states/drive_to_stack.h"
#include "robot/missions/wall/states/drive_to_wall.h"
#include "robot/missions/wall/states/locate_bricks.h"
#include "robot/missions/wall/states/wall_given_up.h"

namespace kiln {
namespace {

constexpr std::array kAskew{0, 1, -1, 2, -2};

}  // namespace

void StoreBrick::enter() {
  WallContext& c = context();
  stage_ = Stage::ReachingBin;
  inserts_ = 0;
  aside_m_ = 0.0;
  side_ = 0;
  turned_ = 0;
  between_ = false;
  if (!c.belief.held || !c.hands) return;
  c.handleBricks();
  // The arm holds meanwhile, with what hangs on it.
  c.parts.arm_control->carry(c.belief.held->payload(c.parts.robot));
  bin_.start(c, c.heldStep(), *c.belief.held);
}

Transition StoreBrick::execute() {
  const WallContext& c = context();
  if (!c.belief.held || !c.hands)
    return transit<LocateBricks>().because("no brick hangs on the gripper");
  switch (stage_) {
    case Stage::ReachingBin:
      return reachBin();
    case Stage::Storing:
      return pollStore();
    case Stage::DrawingBack:
      return drawBack();
  }
  return stay();
}

Transition StoreBrick::reachBin() {
  WallContext& c = context();
  const SkillStatus bin = bin_.poll(now());
  display(c.belief.held->name + ": " + bin.text);
  if (bin.phase == SkillPhase::Failed) return failed(bin.text);
  if (bin.phase != SkillPhase::Done) return stay();
  stage_ = Stage::Storing;
  beginStore();
  return stay();
}

void StoreBrick::beginStore() {
  WallContext& c = context();
  const LoadingConfig& loading = c.config.loading;
  const double half_m = 0.5 * brickShape(c.belief.held->kind).length_m;
  const double askew_rad = loading.askew_m / half_m * kAskew[turned_ % kAskew.size()];
  const auto beside = [&](const Eigen::Isometry3d& X_base_brick) -> Eigen::Isometry3d {
    return X_base_brick * Eigen::Translation3d(0, aside_m_, 0) *
           Eigen::AngleAxisd(askew_rad, Eigen::Vector3d::UnitZ());
  };
  std::vector<Eigen::Isometry3d> way = c.seatWay(bin_.step(), bin_.posture());
  for (Eigen::Isometry3d& X : way) X = beside(X);
  c.hands->store.start(
      {*c.belief.held, beside(c.X_base_seat(bin_.step(), bin_.posture(), c.config.storage.front_m)),
       c.aroundHands(), std::nullopt, std::move(way)},
      now());
}

Transition StoreBrick::pollStore() {
  WallContext& c = context();
  const SkillStatus store = c.hands->store.poll(now());
  display(c.belief.held->name + ": " + store.text);
  if (store.phase == SkillPhase::Failed) {
    if (c.hands->store.hasLetGo()) return stored(store.text);
    if (c.hands->store.drop()) c.belief.held.reset();
    if (c.belief.held && store.failure_code == "contact" &&
        ++inserts_ < c.config.loading.max_tries) {
      met_ = store.text;
      giveWay();
      logger("wall")->info("{}, place {}: {}", c.belief.held->name, inserts_, met_);
      stage_ = Stage::DrawingBack;
      c.parts.arm.startBack(c.config.loading.back_s, now());
      return stay();
    }
    const bool from_elsewhere =
        store.failure_code == "in_collision" || store.failure_code == "unreachable";
    if (c.belief.held && from_elsewhere && bin_.tryNext()) {
      stage_ = Stage::ReachingBin;
      return stay();
    }
    return failed(store.text);
  }
  if (store.phase != SkillPhase::Done) return stay();
  return stored("");
}

Transition StoreBrick::stored(const std::string& after) {
  WallContext& c = context();
  std::string name = c.belief.held->name;
  if (!after.empty()) name += " (" + after + ")";
  const bool back = c.belief.unloading();
  c.belief.held.reset();
  c.belief.handling_faults = 0;
  if (back) {
    --c.belief.taken_out;
    return transit<DriveToWall>().because(name + " is back in its bin");
  }
  ++c.belief.stored;
  const std::string how_far =
      fmt::format("{} stands in the storage, {} of {}", name, c.belief.stored, c.toStore());
  if (c.loaded()) return transit<DriveToMarker>().because(how_far);
  // What was under another brick or beside it is looked at once more, even from where it is taken.
  const auto next = c.nextBrick();
  if (!next || c.standsAt(c.takingPose(*next))) return transit<LocateBricks>().because(how_far);
  return transit<DriveToStack>().because(how_far);
}

/// Away from the side on which it met the wall, by the lever of what the wrist feels there. When that
/// was the one side and now is the other, it belongs between them. If it does not fit there either,
/// or not within what it can be beside, it is turned and tried in the middle.
void StoreBrick::giveWay() {
  const WallContext& c = context();
  const auto arm = c.parts.arm_device.state();
  if (!arm) return;
  const Eigen::Matrix3d R = c.X_base_seat(bin_.step(), bin_.posture()).linear().transpose() *
                            c.parts.robot.X_base_armbase.pose().linear();
  const Eigen::Vector3d force = R * arm->wrench_tool.head<3>();
  const Eigen::Vector3d torque = R * arm->wrench_tool.tail<3>();
  const int side = torque.x() * force.z() > 0.0 ? 1 : -1;  // Y of the seat, pushed out along its Z
  const LoadingConfig& loading = c.config.loading;
  const bool flipped = side_ == -side;
  const double aside_m = aside_m_ - side * loading.aside_m * (flipped ? 0.5 : 1.0);
  if (between_ || std::abs(aside_m) > loading.most_aside_m) {
    ++turned_;
    side_ = 0;
    between_ = false;
    aside_m_ = 0.0;
    return;
  }
  between_ = flipped;
  side_ = side;
  aside_m_ = aside_m;
}

/// Where it came from, then in again a little beside: what hangs is known to some millimetres only.
Transition StoreBrick::drawBack() {
  WallContext& c = context();
  const SkillStatus back = c.parts.arm.poll(now());
  display(c.belief.held->name + " is drawn back: " + met_);
  if (back.phase == SkillPhase::Failed) return failed(met_ + "; and back: " + back.text);
  if (back.phase != SkillPhase::Done) return stay();
  stage_ = Stage::Storing;
  beginStore();
  return stay();
}

Transition StoreBrick::failed(const std::string& why) {
  WallContext& c = context();
  if (++c.belief.handling_faults > c.config.loading.max_faults)
    return transit<WallGivenUp>().because("a brick cannot be stored: " + why);
  if (!c.belief.held && c.belief.unloading())
    return transit<WallGivenUp>().because("a brick that is needed next is lost: " + why);
  if (!c.belief.held) return transit<LocateBricks>().because(why);
  return transit<StoreBrick>().because("once more: " + why);
}

}  // namespace kiln
