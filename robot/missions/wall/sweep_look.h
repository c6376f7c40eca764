#pragma once

#include <memory>
#include <optional>

#include "robot/missions/common/mission_parts.h"
#include "robot/missions/common/pool_question.h"
#include "robot/missions/wall/skills/lidar_sweep.h"
#include "robot/missions/wall/skills/view_planner.h"

namespace kiln {

/// A look at bricks with the LiDAR: the pool chooses the views among what stands around, then the
/// arm makes one sweep after the other. The base rests and goes on doing so.
/// Failure codes: no_view (none can be made; the sentence says why), else those of LidarSweep.
/// Confined to the mission thread.
class SweepLook {
 public:
  struct Config {
    ViewPlanner::Config views;
    LidarSweep::Config sweep;
    double plan_latency_s = 0.2;  ///< modelled in lockstep
    void visit(ConfigArchive& a);
  };
  /// @param parts  outlive it.
  SweepLook(const Config& config, const MissionParts& parts);

  /// @param expected  what is to be seen; nullopt: whatever stands ahead.
  /// @param on_base   in base: what the arm keeps clear of beside the arena, as its terms say.
  void start(std::optional<ExpectedBricks> expected, std::vector<OrientedBox> on_base);
  [[nodiscard]] SkillStatus poll(Stamp now);
  void cancel();
  /// All sweeps together, in base. @pre Done
  [[nodiscard]] std::shared_ptr<const BrickSweep> sweep() const { return all_; }

 private:
  enum class Stage { Idle, Planning, Sweeping, Done, Failed };
  SkillStatus end(Stage stage, SkillStatus status);
  SkillStatus planned(Stamp now);

  Config config_;
  MissionParts parts_;
  PoolQuestion<Result<ViewPlan>> views_;
  LidarSweep lidar_;
  Stage stage_ = Stage::Idle;
  ViewPlan plan_;
  std::size_t next_ = 0;  ///< view that is being swept
  std::shared_ptr<BrickSweep> all_;
  SkillStatus ended_;
};

}  // namespace kiln
