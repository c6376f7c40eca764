#pragma once

#include "robot/missions/fire/fire_state.h"

namespace kiln {

/// The mission cannot go on: everything rests where it is, pumps off. The operator decides.
class SafeStop : public BareFireState<SafeStop, To<>, Terminal<false>> {
 public:
  static constexpr const char* kGroup = kFaults;
  static constexpr const char* kDoc = "The mission has given up: everything rests where it is";
  static constexpr const char* kConsequence =
      "Base and arm stop where they are, the pumps stop, the mission ends";
  void enter() override;
  Transition execute() override { return stay(); }
};

}  // namespace kiln
