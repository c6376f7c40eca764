#pragma once

#include "robot/missions/fire/fire_state.h"

namespace kiln {

class ArmSearch;
class NextLocation;

/// The heat source went out of sight while aiming: search it anew once, then go on.
class LostTarget : public FireState<LostTarget, To<ArmSearch, NextLocation>> {
 public:
  static constexpr const char* kGroup = kFaults;
  static constexpr const char* kDoc = "The heat source was lost while aiming";
  static constexpr const char* kConsequence = "The arm searches once more, then the robot goes on";
  static std::string denyEntry(const FireContext& context) { return context.whyNoPlace(); }
  void arrive() override;
  void enter() override;
  Transition execute() override;
};

}  // namespace kiln
