#pragma once

#include "robot/missions/fire/fire_state.h"

namespace kiln {

class StartPump;
class NextLocation;
class SafeStop;

/// A pump has duty but draws no current: dry, blocked or broken. Stop, rest, try once more; then go
/// on with the other pump if that one works, else to the next place, and when there is none to the
/// safe stop.
class PumpFault : public FireState<PumpFault, To<StartPump, NextLocation, SafeStop>> {
 public:
  static constexpr const char* kGroup = kFaults;
  static constexpr const char* kDoc = "The pumps draw no current or do not run";
  static constexpr const char* kConsequence = "The pumps stop, rest and are tried once more";
  static std::string denyEntry(const FireContext& context) { return context.whyNoPlace(); }
  void arrive() override;
  void enter() override;
  Transition execute() override;

 private:
  std::array<bool, 2> broken_{};
};

}  // namespace kiln
