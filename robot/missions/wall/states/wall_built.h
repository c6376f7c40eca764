#pragma once

#include "robot/missions/wall/wall_state.h"

namespace kiln {

/// Every brick of the blueprint is set.
class WallBuilt : public BareWallState<WallBuilt, To<>, Terminal<true>> {
 public:
  static constexpr const char* kGroup = kManipulation;
  static constexpr const char* kLabel = "Wall built";
  static constexpr const char* kDoc = "Every brick of the blueprint is set";
  static constexpr const char* kConsequence = "Base and arm stop where they are, the mission ends";
  void enter() override;
  Transition execute() override { return stay(); }
};

}  // namespace kiln
