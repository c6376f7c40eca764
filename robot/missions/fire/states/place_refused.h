#pragma once

#include "robot/missions/fire/fire_state.h"

namespace kiln {

class CheckPlace;
class ArmSearch;
class NextLocation;

/// The fire box does not stand where it was configured, or was not seen there: nothing moves until
/// the operator has looked at both. A nudge of the place is checked anew; forcing "Arm search" goes
/// on in spite of it; without an answer the place is left out.
class PlaceRefused : public FireState<PlaceRefused, To<CheckPlace, ArmSearch, NextLocation>,
                                      ResumeAt<CheckPlace>> {
 public:
  static constexpr const char* kGroup = kFaults;
  static constexpr const char* kLabel = "Place refused";
  static constexpr const char* kDoc =
      "The fire box is not where it was configured; waits for the operator";
  static constexpr const char* kConsequence =
      "Everything rests until the place is nudged, or the robot is told to go on";
  static std::string denyEntry(const FireContext& context) { return context.whyNoPlace(); }
  void enter() override;
  Transition execute() override;
  void resume() override {}  ///< the operator may have nudged the place meanwhile

 private:
  int nudges_ = 0;
};

}  // namespace kiln
