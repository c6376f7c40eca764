#pragma once

#include "robot/missions/wall/wall_state.h"

namespace kiln {

/// Pile, bricks and marker are found and the build order is known: everything that is done before
/// the first brick is set.
class WallSurveyed : public BareWallState<WallSurveyed, To<>, Terminal<true>> {
 public:
  static constexpr const char* kGroup = kPerception;
  static constexpr const char* kLabel = "Site surveyed";
  static constexpr const char* kDoc = "Pile, bricks and marker are found; sets no brick yet";
  static constexpr const char* kConsequence = "Base and arm stop where they are, the mission ends";
  void enter() override;
  Transition execute() override { return stay(); }
};

}  // namespace kiln
