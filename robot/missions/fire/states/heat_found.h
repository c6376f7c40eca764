#pragma once

#include "robot/missions/fire/fire_state.h"

namespace kiln {

class AimHose;
class ArmSearch;
class NextLocation;

/// "Has Thermal Detection?": a place counts as not burning only if the plate would have been hot by
/// the whole sweep.
class HeatFound : public FireState<HeatFound, To<AimHose, ArmSearch, NextLocation>> {
 public:
  static constexpr const char* kGroup = kSearchFire;
  static constexpr const char* kLabel = "Has thermal detection?";
  static constexpr const char* kDoc = "Decides whether the place burns";
  static constexpr const char* kConsequence =
      "The robot aims if it has found the heat source, else goes on";
  static std::string denyEntry(const FireContext& context) { return context.whyNoPlace(); }
  Transition execute() override;
};

}  // namespace kiln
