#pragma once

#include "robot/missions/wall/wall_state.h"

namespace kiln {

class DriveToPile;
class DriveToMarker;
class DriveToWall;
class LocateBricks;

/// A drive failed: rest, then once more from the next place beside the last one, a bounded number
/// of times.
class WallDriveBlocked
    : public WallState<WallDriveBlocked, To<DriveToPile, DriveToMarker, DriveToWall, LocateBricks>,
                       ResumeAt<DriveToPile>> {
 public:
  static constexpr const char* kGroup = kFallback;
  static constexpr const char* kLabel = "Drive blocked";
  static constexpr const char* kDoc = "A drive failed";
  static constexpr const char* kConsequence = "The robot rests, then drives to another place near";
  explicit WallDriveBlocked(std::string why) : why_(std::move(why)) {}
  void arrive() override;
  void enter() override { context().halt(); }
  Transition execute() override;

 private:
  std::string why_;
};

}  // namespace kiln
