#pragma once

#include <optional>

#include "robot/perception/bricks/brick_poses.h"
#include "robot/perception/bricks/brick_sweep.h"
#include "robot/perception/bricks/rough_pose.h"

namespace kiln {

/// What a sweep says of a pile or wall.
struct BrickSight {
  RoughPose target;
  GroundFit ground;
  BrickPoses bricks;  ///< empty if individual poses were not asked for
};

/// The pipeline from a sweep to the poses of bricks: preparation, rough pose, individual bricks,
/// confidence (NimbRo UGV paper, "Brick and Wall Perception"). Confined to one thread.
/// Cost: tests/bench/bricks_bench.
class BrickPerception {
 public:
  struct Config {
    double margin_m = 0.6;  ///< around the bricks: where to look, and the ground that counts
    SweepPreparation preparation;
    RoughPoseEstimator::Config rough;
    BrickPoseEstimator::Config bricks;
    void visit(ConfigArchive& a);
  };
  /// @param clock  for the times in the result; nullptr: they are zero.
  explicit BrickPerception(const Config& config, const Clock* clock = nullptr);

  /// @param individual  false: only the target as a whole.
  /// @return the first step's Error that failed: Degenerate with the reason, or InvalidInput.
  [[nodiscard]] Result<BrickSight> perceive(const BrickSweep& sweep, const BrickTarget& target,
                                            bool individual = true);

 private:
  Config config_;
  RoughPoseEstimator rough_;
  BrickPoseEstimator bricks_;
};

}  // namespace kiln
