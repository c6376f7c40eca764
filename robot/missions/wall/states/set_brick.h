#pragma once

#include "robot/missions/wall/bin_exit.h"
#include "robot/missions/wall/wall_state.h"

namespace kiln {

class DriveToWall;
class LocateWall;
class TakeOutBrick;
class WallBuilt;

/// Sets the brick on the gripper into the wall, by force against what bears it and what stands
/// beside it (paper, "Multi Purpose End-effector").
class SetBrick : public WallState<SetBrick, To<DriveToWall, LocateWall, TakeOutBrick, WallBuilt>> {
 public:
  static constexpr const char* kGroup = kManipulation;
  static constexpr const char* kDoc = "Sets the brick on the gripper into the wall";
  static constexpr const char* kConsequence =
      "The arm carries the brick over the wall, sets it down and lets it go";
  static constexpr bool kMayHold = true;
  void enter() override;
  Transition execute() override;

 private:
  void beginSet();
  [[nodiscard]] Transition leaveBin();
  [[nodiscard]] Transition pollSet();
  /// @param after  what the arm met when it left; empty: nothing
  [[nodiscard]] Transition placed(const std::string& after);
  [[nodiscard]] Transition drawBack();
  [[nodiscard]] Transition failed(const std::string& why);
  bool away_ = false;  ///< from where it can be set: it goes back into its bin
  enum class Stage { LeavingBin, Setting, DrawingBack };
  Stage stage_ = Stage::Setting;
  BinExit exit_;
  std::string met_;
};

}  // namespace kiln
