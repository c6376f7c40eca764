#pragma once

#include "robot/missions/fire/fire_state.h"

namespace kiln {

class SpraySteady;
class AimHose;
class PumpFault;

/// "Start Pump": a pump that runs dry or is blocked shows by its current.
class StartPump
    : public FireState<StartPump, To<SpraySteady, AimHose, PumpFault>, OnTimeout<PumpFault>> {
 public:
  static constexpr const char* kGroup = kExtinguish;
  static constexpr const char* kDoc = "Starts the pumps and waits until they draw current";
  static constexpr const char* kConsequence = "The pumps start and water leaves the nozzle";
  static double timeLimit(const FireContext& context) {
    return context.config.spray.start_timeout_s;
  }
  static std::string denyEntry(const FireContext& context) { return context.whyNoPlace(); }
  Transition execute() override;
};

}  // namespace kiln
