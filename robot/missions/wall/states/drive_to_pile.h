#pragma once

#include "robot/missions/wall/wall_state.h"

namespace kiln {

class FindPile;
class LocateBricks;
class WallDriveBlocked;

/// To where the pile is looked for, with the arm stowed.
class DriveToPile : public WallState<DriveToPile, To<FindPile, LocateBricks, WallDriveBlocked>> {
 public:
  static constexpr const char* kGroup = kLocomotion;
  static constexpr const char* kDoc = "Drives to where the pile can be seen";
  static constexpr const char* kConsequence =
      "The arm is stowed, then the robot drives to the pile";
  void enter() override;
  Transition execute() override;
};

}  // namespace kiln
