#pragma once

#include "robot/missions/mapping/mapping_state.h"

namespace kiln {

class MappingDone;
class MappingBlocked;

/// The round itself. A second try goes on with the way-points that are left.
class MappingRound : public MappingState<MappingRound, To<MappingDone, MappingBlocked>> {
 public:
  static constexpr const char* kDoc =
      "Drives the arena's mapping path from the start through the building and back";
  static constexpr const char* kConsequence =
      "The arm is stowed, then the robot drives what is left of the mapping path";
  void enter() override;
  Transition execute() override;
};

}  // namespace kiln
