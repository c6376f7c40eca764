#pragma once

#include "robot/missions/mapping/mapping_state.h"

namespace kiln {

class MappingDone : public MappingState<MappingDone, To<>, Terminal<true>> {
 public:
  static constexpr const char* kDoc = "The round is driven: the robot stands where it began";
  static constexpr const char* kConsequence = "Base and arm stop, the drive ends as a success";
  void enter() override;
  Transition execute() override { return stay(); }
};

}  // namespace kiln
