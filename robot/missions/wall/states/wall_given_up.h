#pragma once

#include "robot/missions/wall/wall_state.h"

namespace kiln {

/// The mission cannot go on: everything rests where it is. The operator decides.
class WallGivenUp : public BareWallState<WallGivenUp, To<>, Terminal<false>> {
 public:
  static constexpr const char* kGroup = kFallback;
  static constexpr const char* kLabel = "Given up";
  static constexpr const char* kDoc = "The mission has given up: everything rests where it is";
  static constexpr const char* kConsequence = "Base and arm stop where they are, the mission ends";
  void enter() override;
  Transition execute() override { return stay(); }
};

}  // namespace kiln
