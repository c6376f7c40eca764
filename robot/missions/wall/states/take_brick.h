#pragma once

#include "robot/missions/wall/wall_state.h"

namespace kiln {

class DriveToStack;
class LocateBricks;

/// Takes the next brick from the pile (paper, "Multi Purpose End-effector").
class TakeBrick : public WallState<TakeBrick, To<DriveToStack, LocateBricks>> {
 public:
  static constexpr const char* kGroup = kManipulation;
  static constexpr const char* kDoc = "Takes the next brick from the pile";
  static constexpr const char* kConsequence =
      "The arm lowers the gripper onto a brick, switches the magnets on and lifts it";
  void enter() override;
  Transition execute() override;

 private:
  [[nodiscard]] Transition taken(HeldBrick held);
  std::optional<std::size_t> brick_;
  bool hangs_ = false;  ///< it was gripped before an interruption
};

}  // namespace kiln
