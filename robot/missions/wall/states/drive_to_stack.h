#pragma once

#include "robot/missions/wall/wall_state.h"

namespace kiln {

class LocateBricks;
class WallDriveBlocked;

/// To where the stack is looked at from which the next brick is taken, with the arm stowed.
class DriveToStack : public WallState<DriveToStack, To<LocateBricks, WallDriveBlocked>> {
 public:
  static constexpr const char* kGroup = kLocomotion;
  static constexpr const char* kDoc = "Drives to where the next stack can be looked at";
  static constexpr const char* kConsequence =
      "The arm is stowed, then the robot drives to the pile";
  void enter() override;
  Transition execute() override;

 private:
  bool nothing_ = false;  ///< to drive to
};

}  // namespace kiln
