#pragma once

#include "robot/missions/fire/fire_state.h"

namespace kiln {

/// "Stop": both places were visited and the fire got its water.
class Finished : public BareFireState<Finished, To<>, Terminal<true>> {
 public:
  static constexpr const char* kGroup = kSearchFire;
  static constexpr const char* kDoc = "The mission has ended: the fire got its water";
  static constexpr const char* kConsequence =
      "Everything comes to rest and the mission ends as a success";
  void enter() override;
  Transition execute() override { return stay(); }
};

}  // namespace kiln
