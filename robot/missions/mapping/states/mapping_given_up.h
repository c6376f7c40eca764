#pragma once

#include "robot/missions/mapping/mapping_state.h"

namespace kiln {

class MappingGivenUp : public MappingState<MappingGivenUp, To<>, Terminal<false>> {
 public:
  static constexpr const char* kDoc = "The round could not be driven to its end";
  static constexpr const char* kConsequence = "Base and arm stop, the drive ends as a failure";
  void enter() override;
  Transition execute() override { return stay(); }
};

}  // namespace kiln
