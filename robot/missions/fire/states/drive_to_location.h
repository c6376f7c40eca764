#pragma once

#include "robot/missions/fire/fire_state.h"

namespace kiln {

class CheckPlace;
class DriveBlocked;
class ArmBlocked;

/// "UGV Drive to Location": the pre-determined pose roughly in front of the fire place.
class DriveToLocation
    : public FireState<DriveToLocation, To<CheckPlace, DriveBlocked, ArmBlocked>> {
 public:
  static constexpr const char* kGroup = kSearchFire;
  static constexpr const char* kDoc = "Drives to the pose in front of the chosen fire place";
  static constexpr const char* kConsequence =
      "The arm is stowed, then the robot drives to the fire place";
  static std::string denyEntry(const FireContext& context) { return context.whyNoPlace(); }
  void enter() override;
  Transition execute() override;
};

}  // namespace kiln
