#pragma once

#include "robot/missions/wall/wall_state.h"

namespace kiln {

class LocateBricks;
class WallDriveBlocked;

/// From where the bricks were looked at straight to where the next one is taken, with the arm stowed.
class ApproachStack : public WallState<ApproachStack, To<LocateBricks, WallDriveBlocked>> {
 public:
  static constexpr const char* kGroup = kLocomotion;
  static constexpr const char* kDoc = "Drives up to the stack from which the next brick is taken";
  static constexpr const char* kConsequence =
      "The arm is stowed, then the robot drives up to the pile";
  void enter() override;
  Transition execute() override;

 private:
  bool nothing_ = false;  ///< to drive to
};

}  // namespace kiln
