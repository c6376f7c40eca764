#pragma once

#include "robot/missions/fire/fire_state.h"

namespace kiln {

class Finished;
class NothingFound;
class SafeStop;

/// On the way to "Stop": folds the arm above the deck.
class ParkArm
    : public FireState<ParkArm, To<Finished, NothingFound, SafeStop>, OnTimeout<SafeStop>> {
 public:
  static constexpr const char* kGroup = kSearchFire;
  static constexpr const char* kDoc = "Folds the arm above the deck before the mission ends";
  static constexpr const char* kConsequence =
      "The arm moves to its park pose, then the mission ends";
  static double timeLimit(const FireContext& context) { return context.config.clock.park_limit_s; }
  void enter() override;
  Transition execute() override;
};

}  // namespace kiln
