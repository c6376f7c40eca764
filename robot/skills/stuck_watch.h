#pragma once

#include <deque>

#include "common/core/stamp.h"
#include "common/geom/pose.h"

namespace kiln {

/// Does the base go where its wheels are told to? Compares the commanded way with what the wheels
/// report and with what the pose says, at each tick over the last window of time. Confined to the
/// mission thread.
class StuckWatch {
 public:
  struct Config {
    double window_s = 2.0;
    double ratio = 0.3;    ///< less of the commanded way than this is stuck
    double lever_m = 1.0;  ///< metres that a radian of turning counts
  };
  explicit StuckWatch(Config config) : config_(config) {}

  void restart(Stamp now, const Pose2& X_map_base);
  /// Call each tick, `dt_s` after the last one.
  /// @return too little of the way commanded in the last window was covered.
  [[nodiscard]] bool update(Stamp now, double dt_s, const Pose2& X_map_base,
                            const Twist2& commanded, const Twist2& measured);

 private:
  struct Sample {
    Stamp stamp;
    Pose2 X_map_base;
    double commanded_m = 0.0, measured_m = 0.0;  ///< since the restart
  };
  [[nodiscard]] double speed(const Twist2& twist) const;

  Config config_;
  std::deque<Sample> samples_;
};

}  // namespace kiln
