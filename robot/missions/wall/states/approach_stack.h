#pragma once

#include "robot/missions/wall/states/stack_drive.h"

namespace kiln {

/// From where the bricks were looked at straight to where the next one is taken.
class ApproachStack final : public StackDrive<ApproachStack> {
 public:
  static constexpr const char* kGroup = kLocomotion;
  static constexpr const char* kDoc = "Drives up to the stack from which the next brick is taken";
  static constexpr const char* kConsequence =
      "The arm is stowed, then the robot drives up to the pile";
  static Pose2 stand(const WallContext& context, std::size_t pile_brick) {
    return context.takingPose(pile_brick);
  }
};

}  // namespace kiln
