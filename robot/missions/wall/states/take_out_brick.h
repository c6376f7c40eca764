#pragma once

#include "robot/missions/wall/bin_access.h"
#include "robot/missions/wall/wall_state.h"

namespace kiln {

class DriveToWall;
class SetBrick;
class WallBuilt;

/// Takes what is built next out of its bin: the compartments travel to where the arm reaches it, then
/// it is gripped at its plate, lifted a little and led out to the front.
class TakeOutBrick
    : public WallState<TakeOutBrick, To<DriveToWall, SetBrick, TakeOutBrick, WallBuilt>> {
 public:
  static constexpr const char* kGroup = kManipulation;
  static constexpr const char* kDoc = "Takes the brick that is built next out of its bin";
  static constexpr const char* kConsequence =
      "The storage travels, then the arm takes a brick out of a bin";
  void enter() override;
  Transition execute() override;

 private:
  [[nodiscard]] Transition reachBin();
  [[nodiscard]] Transition pollTake();
  [[nodiscard]] Transition taken(HeldBrick held);
  [[nodiscard]] Transition failed(const std::string& why);
  enum class Stage { ReachingBin, Taking };
  Stage stage_ = Stage::ReachingBin;
  KnownBrick brick_;  ///< in base, once its bin stands where it is taken out
  BinAccess bin_;
  bool hangs_ = false;  ///< it was gripped before an interruption
};

}  // namespace kiln
