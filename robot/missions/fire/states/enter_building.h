#pragma once

#include "robot/missions/fire/fire_state.h"

namespace kiln {

class NextLocation;
class DriveBlocked;
class ArmBlocked;

/// "Enter Building": static way-points from the start zone to the hub inside.
class EnterBuilding : public FireState<EnterBuilding, To<NextLocation, DriveBlocked, ArmBlocked>> {
 public:
  static constexpr const char* kGroup = kSearchFire;
  static constexpr const char* kDoc = "Drives by way-points from the start zone into the building";
  static constexpr const char* kConsequence =
      "The arm is stowed, then the robot drives into the building";
  void enter() override;
  Transition execute() override;
};

}  // namespace kiln
