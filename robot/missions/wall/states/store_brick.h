#pragma once

#include "robot/missions/wall/bin_access.h"
#include "robot/missions/wall/wall_state.h"

namespace kiln {

class DriveToMarker;
class DriveToStack;
class DriveToWall;
class LocateBricks;

/// Sets the brick on the gripper into its bin (paper, "Storage System"): the compartments travel to
/// where the plan wants them, then it is set in upright from the front.
class StoreBrick
    : public WallState<StoreBrick, To<DriveToMarker, DriveToStack, DriveToWall, LocateBricks>> {
 public:
  static constexpr const char* kGroup = kManipulation;
  static constexpr const char* kDoc = "Sets the brick on the gripper into its bin";
  static constexpr const char* kConsequence =
      "The storage travels, then the arm carries the brick into a bin and lets it go";
  static constexpr bool kMayHold = true;
  void enter() override;
  Transition execute() override;

 private:
  [[nodiscard]] Transition reachBin();
  [[nodiscard]] Transition pollStore();
  /// @param after  what the arm met when it left; empty: nothing
  [[nodiscard]] Transition stored(const std::string& after);
  [[nodiscard]] Transition drawBack();
  void beginStore();
  void giveWay();
  [[nodiscard]] Transition failed(const std::string& why);
  enum class Stage { ReachingBin, Storing, DrawingBack };
  Stage stage_ = Stage::ReachingBin;
  BinAccess bin_;
  int inserts_ = 0;
  double aside_m_ = 0.0;  ///< of the seat's middle, along its Y
  int side_ = 0;          ///< on which it met something last
  bool between_ = false;  ///< tried between two places where it met the one and the other side
  std::size_t turned_ = 0;
  std::string met_;
};

}  // namespace kiln
