#pragma once

#include "robot/missions/fire/fire_state.h"

namespace kiln {

class EnterBuilding;
class DriveToLocation;
class NextLocation;
class SafeStop;

/// A drive failed or took too long: try once more, then the next place; outside the building the
/// safe stop.
class DriveBlocked
    : public FireState<DriveBlocked, To<EnterBuilding, DriveToLocation, NextLocation, SafeStop>,
                       ResumeAt<NextLocation>> {
 public:
  static constexpr const char* kGroup = kFaults;
  static constexpr const char* kDoc = "A drive failed";
  static constexpr const char* kConsequence =
      "The robot rests, then tries the drive once more or goes on";
  explicit DriveBlocked(std::string why) : why_(std::move(why)) {}
  void arrive() override;
  void enter() override;
  Transition execute() override;

 private:
  [[nodiscard]] Transition outside();

  std::string why_;
};

}  // namespace kiln
