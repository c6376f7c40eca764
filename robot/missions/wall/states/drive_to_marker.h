#pragma once

#include "robot/missions/wall/wall_state.h"

namespace kiln {

class FindMarker;
class WallDriveBlocked;

/// To where the wall's marker is looked for, with the arm stowed.
class DriveToMarker : public WallState<DriveToMarker, To<FindMarker, WallDriveBlocked>> {
 public:
  static constexpr const char* kGroup = kLocomotion;
  static constexpr const char* kDoc = "Drives to where the wall's marker can be seen";
  static constexpr const char* kConsequence =
      "The arm is stowed, then the robot drives to the marker";
  void enter() override;
  Transition execute() override;
};

}  // namespace kiln
