#pragma once

#include "robot/missions/fire/fire_state.h"

namespace kiln {

class Finished;
class SafeStop;

/// The mission clock is near its end: pumps off, arm parked, end.
class TimeNearlyOver : public BareFireState<TimeNearlyOver, To<Finished, SafeStop>> {
 public:
  static constexpr const char* kGroup = kFaults;
  static constexpr const char* kDoc = "The mission clock is near its end";
  static constexpr const char* kConsequence = "The pumps stop, the arm parks and the mission ends";
  void enter() override;
  Transition execute() override;
};

}  // namespace kiln
