#pragma once

#include "robot/missions/wall/wall_context.h"

namespace kiln {

/// Leads the gripper, with what hangs on it, straight out of the bin in which it stands, the way it
/// came: before a compartment travels, and before the arm moves freely again after an interruption.
/// Failure codes: those of MoveArm. Confined to the mission thread.
class BinExit {
 public:
  /// @return false: nothing of it stands in a bin, there is nothing to poll. @pre the robot has hands
  [[nodiscard]] bool start(WallContext& context, Stamp now);
  [[nodiscard]] SkillStatus poll(Stamp now) { return context_->parts.arm.poll(now); }

 private:
  WallContext* context_ = nullptr;
};

}  // namespace kiln
