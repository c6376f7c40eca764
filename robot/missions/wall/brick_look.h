#pragma once

#include "robot/missions/wall/sweep_look.h"
#include "robot/perception/bricks/brick_perception.h"

namespace kiln {

/// A look at bricks, and what it shows of each of them: the sweeps of SweepLook, then the pool's
/// perception. Failure codes: not_seen (nothing that perception could be sure of), else those of
/// SweepLook. Confined to the mission thread, the pool's work aside.
class BrickLook {
 public:
  /// @param look  outlives it.
  BrickLook(SweepLook& look, const BrickPerception::Config& config, double latency_s,
            Executor& executor);

  /// @param on_base  as SweepLook::start()
  void start(const ExpectedBricks& expected, std::vector<OrientedBox> on_base);
  [[nodiscard]] SkillStatus poll(Stamp now);
  void cancel();
  /// @pre Done
  [[nodiscard]] const BrickSight& sight() const { return **question_.answer(); }

 private:
  SweepLook& look_;
  BrickPerception::Config config_;
  PoolQuestion<Result<BrickSight>> question_;
  BrickTarget target_;
  bool asked_ = false;
};

}  // namespace kiln
