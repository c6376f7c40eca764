#pragma once

#include "common/model/localization.h"

namespace kiln {

/// What the robot has driven since the daemon started, one leg for each reset, thinned to what a
/// drawing needs. Bounded: when full, every second pose goes. Confined to the
/// mission thread.
class TrajectoryLog {
 public:
  /// @return whether it has grown.
  bool add(Stamp stamp, const Pose2& X_map_base, int resets);
  [[nodiscard]] const Trajectory& trajectory() const { return trajectory_; }

 private:
  void thin();

  Trajectory trajectory_;
  std::size_t poses_ = 0;
};

}  // namespace kiln
