#pragma once

#include "robot/missions/fire/fire_state.h"

namespace kiln {

class HeatFound;
class ArmBlocked;

/// "Perform Arm Search Motion": sweeps the thermal camera along a rectangle before the place.
class ArmSearch : public FireState<ArmSearch, To<HeatFound, ArmBlocked>, OnTimeout<HeatFound>> {
 public:
  static constexpr const char* kGroup = kSearchFire;
  static constexpr const char* kDoc = "Sweeps the thermal camera before the fire place";
  static constexpr const char* kConsequence =
      "The arm unfolds and moves along a rectangle before the fire place";
  static double timeLimit(const FireContext& context) { return context.config.search.time_limit_s; }
  static std::string denyEntry(const FireContext& context) { return context.whyNoPlace(); }
  void arrive() override;
  void enter() override;
  Transition execute() override;
  void leave() override;
};

}  // namespace kiln
