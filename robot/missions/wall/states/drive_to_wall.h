#pragma once

#include "robot/missions/wall/wall_state.h"

namespace kiln {

class DriveToMarker;
class LocateWall;
class TakeOutBrick;
class WallBuilt;
class WallDriveBlocked;

/// To where the next brick is set, with the arm stowed; then what stands there already is looked at.
class DriveToWall
    : public WallState<DriveToWall,
                       To<DriveToMarker, LocateWall, TakeOutBrick, WallDriveBlocked, WallBuilt>> {
 public:
  static constexpr const char* kGroup = kLocomotion;
  static constexpr const char* kDoc = "Drives to where the next brick is set";
  static constexpr const char* kConsequence =
      "The arm is stowed, then the robot drives up to the wall";
  void enter() override;
  Transition execute() override;
};

}  // namespace kiln
