#pragma once

#include "robot/missions/fire/fire_state.h"

namespace kiln {

class ArmSearch;
class NextLocation;
class SafeStop;

/// The arm touched something, or cannot get where it should: withdraw, try once more, then go on.
class ArmBlocked
    : public FireState<ArmBlocked, To<ArmSearch, NextLocation, SafeStop>, ResumeAt<NextLocation>> {
 public:
  enum class While { Extended, Stowing };
  static constexpr const char* kGroup = kFaults;
  static constexpr const char* kDoc = "The arm was stopped by a contact or cannot reach its goal";
  static constexpr const char* kConsequence =
      "The pumps stop, the arm withdraws and searches once more, or the robot goes on";
  ArmBlocked(std::string why, While when) : why_(std::move(why)), when_(when) {}
  void arrive() override;
  void enter() override;
  Transition execute() override;

 private:
  std::string why_;
  While when_;
};

}  // namespace kiln
