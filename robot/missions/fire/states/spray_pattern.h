#pragma once

#include "robot/missions/fire/fire_state.h"

namespace kiln {

class AimHose;
class StopPump;
class PumpFault;
class ArmBlocked;
class StartPump;

/// "Spray in Pattern", "Phase 2 Complete?": the other half of the water in an hourglass by tilting
/// the end-effector.
class SprayPattern : public FireState<SprayPattern, To<StopPump, PumpFault, ArmBlocked, AimHose>,
                                      OnTimeout<StopPump>, ResumeAt<StartPump>> {
 public:
  static constexpr const char* kGroup = kExtinguish;
  static constexpr const char* kLabel = "Phase 2: pattern";
  static constexpr const char* kDoc = "Sprays the other half of the water in an hourglass pattern";
  static constexpr const char* kConsequence =
      "The pumps run, the end-effector tilts in an hourglass";
  static double timeLimit(const FireContext& context);
  static std::string denyEntry(const FireContext& context);
  void enter() override;
  Transition execute() override;

 private:
  void beginRound();

  bool steady_ = false;  ///< the arm cannot tilt here: the rest is sprayed steadily
  int rounds_ = 0;
};

}  // namespace kiln
