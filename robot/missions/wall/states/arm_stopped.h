#pragma once

#include "robot/missions/wall/wall_state.h"

namespace kiln {

class DriveToPile;
class DriveToMarker;
class DriveToWall;
class LocateBricks;

/// The arm's safety controller has stopped it. Only the operator's release ends this: the vendor
/// prohibits an automatic one. Afterwards the look that was under way begins anew.
class ArmStopped
    : public BareWallState<ArmStopped, To<DriveToPile, DriveToMarker, DriveToWall, LocateBricks,
                                          SetBrick, StoreBrick, WallGivenUp>> {
 public:
  static constexpr const char* kGroup = kFallback;
  static constexpr const char* kLabel = "Protective stop";
  static constexpr const char* kDoc =
      "The arm has stopped itself; waits for the operator's release";
  static constexpr const char* kConsequence =
      "Everything rests until the arm is released; then the work goes on";
  void enter() override { context().halt(); }
  Transition execute() override;
  void resume() override {}  ///< it is still the same stop
};

}  // namespace kiln
