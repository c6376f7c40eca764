#pragma once

#include "robot/missions/fire/fire_state.h"

namespace kiln {

class ArmSearch;
class DriveToLocation;
class NextLocation;
class SafeStop;

/// The arm's safety controller has stopped it. Only the operator's release ends this: the vendor
/// prohibits an automatic one. Afterwards the work at the place begins anew; a second stop there
/// gives the place up.
class ProtectiveStop
    : public BareFireState<ProtectiveStop, To<ArmSearch, DriveToLocation, NextLocation, SafeStop>> {
 public:
  static constexpr const char* kGroup = kFaults;
  static constexpr const char* kDoc =
      "The arm has stopped itself; waits for the operator's release";
  static constexpr const char* kConsequence =
      "Everything rests until the arm is released; then the work goes on";
  void arrive() override;
  void enter() override;
  Transition execute() override;
  void resume() override {}  ///< it is still the same stop

 private:
  [[nodiscard]] Transition goOn();
  std::optional<Stamp> released_;
};

}  // namespace kiln
