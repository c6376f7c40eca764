#pragma once

#include "robot/missions/wall/wall_state.h"

namespace kiln {

class DriveToWall;
class TakeOutBrick;

/// Sweeps the LiDAR over what was built and corrects where the wall stands from here (paper, "Brick
/// and Wall Perception"): the base has driven since.
class LocateWall : public WallState<LocateWall, To<DriveToWall, LocateWall, TakeOutBrick>> {
 public:
  static constexpr const char* kGroup = kPerception;
  static constexpr const char* kDoc = "Sweeps the LiDAR over what was built and finds it again";
  static constexpr const char* kConsequence = "The arm tilts the head; then the robot builds on";
  void enter() override;
  Transition execute() override;

 private:
  [[nodiscard]] Transition conclude(const BrickSight& sight);
  [[nodiscard]] Transition again(const std::string& why);
};

}  // namespace kiln
