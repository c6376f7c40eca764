#pragma once

#include "robot/missions/wall/states/stack_drive.h"

namespace kiln {

/// To where the stack is looked at from which the next brick is taken.
class DriveToStack final : public StackDrive<DriveToStack> {
 public:
  static constexpr const char* kGroup = kLocomotion;
  static constexpr const char* kDoc = "Drives to where the next stack can be looked at";
  static constexpr const char* kConsequence =
      "The arm is stowed, then the robot drives to the pile";
  static Pose2 stand(const WallContext& context, std::size_t pile_brick) {
    return context.stackLookPose(pile_brick);
  }
};

}  // namespace kiln
