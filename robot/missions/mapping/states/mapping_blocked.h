#pragma once

#include "robot/missions/mapping/mapping_state.h"

namespace kiln {

class MappingRound;
class MappingGivenUp;

/// The drive failed: rest, try once more, then give up.
class MappingBlocked : public MappingState<MappingBlocked, To<MappingRound, MappingGivenUp>,
                                           ResumeAt<MappingRound>> {
 public:
  static constexpr const char* kDoc = "The mapping drive failed";
  static constexpr const char* kConsequence = "The robot rests, then tries once more or gives up";
  explicit MappingBlocked(std::string why) : why_(std::move(why)) {}
  void arrive() override;
  Transition execute() override;

 private:
  std::string why_;
};

}  // namespace kiln
