#pragma once

#include "robot/missions/wall/wall_state.h"

namespace kiln {

class DriveToPile;
class LocateBricks;

/// Sweeps the LiDAR over what stands ahead and looks for the pile there (paper, "Rough Pile
/// Detection").
class FindPile : public WallState<FindPile, To<DriveToPile, LocateBricks>> {
 public:
  static constexpr const char* kGroup = kPerception;
  static constexpr const char* kDoc = "Sweeps the LiDAR over what stands ahead, looks for the pile";
  static constexpr const char* kConsequence = "The arm tilts the head; then the robot goes on";
  void arrive() override { ++context().belief.pile_looks; }
  void enter() override { started_ = asked_ = false; }
  Transition execute() override;

 private:
  [[nodiscard]] Transition conclude(const PileAnswer& answer);
  [[nodiscard]] Transition again(const std::string& why);
  bool started_ = false, asked_ = false;
};

}  // namespace kiln
