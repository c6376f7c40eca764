#pragma once

#include "robot/missions/fire/fire_state.h"

namespace kiln {

class EnterBuilding;
class DriveToLocation;
class ParkArm;

/// "Has Next Location?": both places are visited in turn, the second also after a success. While no
/// fire was found, another round begins.
class NextLocation : public FireState<NextLocation, To<DriveToLocation, EnterBuilding, ParkArm>> {
 public:
  static constexpr const char* kGroup = kSearchFire;
  static constexpr const char* kLabel = "Has next location?";
  static constexpr const char* kDoc = "Chooses the next fire place that was not visited";
  static constexpr const char* kConsequence =
      "The robot goes on to the next fire place, or parks its arm and ends";
  Transition execute() override;
};

}  // namespace kiln
