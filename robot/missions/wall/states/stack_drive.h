#pragma once

#include "robot/missions/wall/states/locate_bricks.h"
#include "robot/missions/wall/states/wall_drive_blocked.h"
#include "robot/missions/wall/wall_state.h"

namespace kiln {

/// To before the stack from which the next brick is taken, with the arm stowed; then the bricks are
/// looked at. Derived says where: `static Pose2 stand(const WallContext&, std::size_t pile_brick)`.
template <class Derived>
class StackDrive : public WallState<Derived, To<LocateBricks, WallDriveBlocked>> {
 public:
  void enter() override {
    WallContext& c = this->context();
    const auto next = c.nextBrick();
    nothing_ = !next;
    if (next) c.drive.start({Derived::stand(c, *next)}, this->now());
  }

  Transition execute() override {
    WallContext& c = this->context();
    if (nothing_)
      return this->template transit<LocateBricks>().because("it is not known from where to take");
    const SkillStatus drive = c.drive.poll(this->now());
    this->guard("Arm stowed", c.drive.stowed());
    this->display("to the stack: " + drive.text);
    if (drive.phase == SkillPhase::Failed)
      return this->template transit<WallDriveBlocked>(drive.text).because(drive.text);
    if (drive.phase != SkillPhase::Done) return this->stay();
    c.belief.drive_faults = 0;
    return this->template transit<LocateBricks>().because("before the stack");
  }

 private:
  bool nothing_ = false;  ///< to drive to
};

}  // namespace kiln
