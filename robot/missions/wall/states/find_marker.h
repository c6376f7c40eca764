#pragma once

#include <optional>
#include <vector>

#include "robot/missions/wall/wall_state.h"

namespace kiln {

class DriveToMarker;
class DriveToWall;
class WallSurveyed;

/// Moves the head over the ground ahead and looks for the wall's marker (paper, "Wall Marker
/// Detection").
class FindMarker : public WallState<FindMarker, To<DriveToMarker, DriveToWall, WallSurveyed>> {
 public:
  static constexpr const char* kGroup = kPerception;
  static constexpr const char* kDoc = "Looks for the wall's marker through the head camera";
  static constexpr const char* kConsequence =
      "The arm moves the head over the ground ahead of the robot";
  void arrive() override { ++context().belief.marker_looks; }
  void enter() override;
  Transition execute() override;

 private:
  [[nodiscard]] Transition look();
  [[nodiscard]] Transition conclude(const MarkerSearch& search);
  [[nodiscard]] Transition again(const std::string& why);

  std::vector<Vector6d> postures_;
  std::size_t next_ = 0;
  std::optional<Stamp> rests_since_;
};

}  // namespace kiln
