#pragma once

#include "robot/missions/fire/fire_state.h"

namespace kiln {

class SprayPattern;
class AimHose;
class StopPump;
class PumpFault;
class StartPump;

/// "Phase 1 Complete?": the first half of the water, the hose kept steady. After a restart the
/// pumps are started anew.
class SpraySteady : public FireState<SpraySteady, To<SprayPattern, StopPump, PumpFault, AimHose>,
                                     OnTimeout<StopPump>, ResumeAt<StartPump>> {
 public:
  static constexpr const char* kGroup = kExtinguish;
  static constexpr const char* kLabel = "Phase 1: steady";
  static constexpr const char* kDoc = "Sprays the first half of the water with a steady hose";
  static constexpr const char* kConsequence = "The pumps run, the arm stands still";
  static double timeLimit(const FireContext& context);
  static std::string denyEntry(const FireContext& context);
  Transition execute() override;
};

}  // namespace kiln
