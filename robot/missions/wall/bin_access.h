#pragma once

#include <vector>

#include "robot/missions/wall/bin_exit.h"

namespace kiln {

/// Brings a bin to where the arm can lead a brick into it, or out of it: the compartment's planned
/// position, else the nearest one of its travel; then it travels there. One position a poll is asked
/// of the arm. No compartment travels while gripper or brick stand in a bin: they are led out first.
/// Failure codes: unreachable, else those of BinExit and MoveStorage. Confined to the mission thread.
class BinAccess {
 public:
  /// @pre the robot has hands
  void start(WallContext& context, const StorageStep& step, const HeldBrick& brick);
  [[nodiscard]] SkillStatus poll(Stamp now);
  /// The next position that the arm can work with. @return false: none is left.
  [[nodiscard]] bool tryNext();

  [[nodiscard]] const StorageStep& step() const { return step_; }
  /// @pre Done
  [[nodiscard]] const StoragePosture& posture() const { return postures_[tried_]; }

 private:
  [[nodiscard]] std::vector<StoragePosture> candidates() const;
  [[nodiscard]] Result<void> check(const StoragePosture& posture) const;

  WallContext* context_ = nullptr;
  StorageStep step_;
  HeldBrick brick_;
  std::vector<StoragePosture> postures_;  ///< to be tried, the planned one first
  std::size_t tried_ = 0;
  enum class Stage { Begun, Leaving, Asking, Travelling };
  Stage stage_ = Stage::Begun;
  BinExit exit_;
};

}  // namespace kiln
