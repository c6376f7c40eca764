#pragma once

#include "robot/missions/wall/wall_state.h"

namespace kiln {

class ApproachStack;
class DriveToMarker;
class DriveToPile;
class DriveToStack;

/// Sweeps the LiDAR over the pile from the views that show its bricks, and finds each of them
/// (paper, "Individual Brick Pose Estimation").
class LocateBricks
    : public WallState<LocateBricks,
                       To<ApproachStack, DriveToPile, DriveToStack, DriveToMarker, TakeBrick>> {
 public:
  static constexpr const char* kGroup = kPerception;
  static constexpr const char* kDoc = "Sweeps the LiDAR over the pile and finds each brick";
  static constexpr const char* kConsequence = "The arm tilts the head; then the robot goes on";
  void arrive() override { ++context().belief.brick_looks; }
  void enter() override;
  Transition execute() override;

 private:
  [[nodiscard]] Transition conclude(const BrickSight& sight);
  [[nodiscard]] Transition goOn(const std::string& found);
  [[nodiscard]] Transition again(const std::string& why);
};

}  // namespace kiln
