#pragma once

#include "robot/missions/fire/fire_state.h"

namespace kiln {

class NextLocation;

/// "Stop Pump": and this place is done.
class StopPump : public FireState<StopPump, To<NextLocation>, OnTimeout<NextLocation>> {
 public:
  static constexpr const char* kGroup = kExtinguish;
  static constexpr const char* kDoc = "Stops the pumps and closes the place";
  static constexpr const char* kConsequence = "The pumps stop; the place counts as visited";
  static double timeLimit(const FireContext& context) {
    return context.config.spray.start_timeout_s;
  }
  static std::string denyEntry(const FireContext& context) { return context.whyNoPlace(); }
  void enter() override;
  Transition execute() override;
};

}  // namespace kiln
