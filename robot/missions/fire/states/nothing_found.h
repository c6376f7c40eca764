#pragma once

#include "robot/missions/fire/fire_state.h"

namespace kiln {

/// All places were visited in all rounds and none got its water.
class NothingFound : public BareFireState<NothingFound, To<>, Terminal<false>> {
 public:
  static constexpr const char* kGroup = kFaults;
  static constexpr const char* kDoc = "The mission has ended: no fire was found and sprayed";
  static constexpr const char* kConsequence =
      "Everything comes to rest and the mission ends without success";
  void enter() override;
  Transition execute() override { return stay(); }
};

}  // namespace kiln
