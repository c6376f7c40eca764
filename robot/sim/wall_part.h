#pragma once

#include <optional>
#include <string>
#include <vector>

#include "robot/sim/brick_bodies.h"
#include "robot/sim/wall_referee.h"
#include "robot/sim/world_part.h"

namespace kiln::sim {

/// Where a brick is kept on the robot.
struct BinPlace {
  std::size_t compartment = 0;
  int bin = 0;
};

struct BrickTruth {
  std::string name;
  BrickKind kind = BrickKind::Red;
  Eigen::Isometry3d X_map_brick = Eigen::Isometry3d::Identity();
  bool held = false, at_rest = false;
  std::optional<BinPlace> stored;
  std::optional<std::size_t> slot;  ///< of the wall, that it fills
  int falls = 0;                    ///< knocked over or off, or dropped
};

/// What truly happened with the bricks.
struct WallTruth {
  Pose2 X_map_pile;
  Eigen::Isometry3d X_map_marker = Eigen::Isometry3d::Identity();
  std::vector<WallSlot> slots;
  std::vector<BrickTruth> bricks;  ///< empty: no wall in this world
  WallScore score;
  int falls = 0;
};

/// The bricks: where they are, whose fall counts, and what the wall is worth.
class WallPart final : public WorldPart {
 public:
  /// @param arena, robot  outlive it.
  WallPart(const TrueArena& arena, const RobotGeometry& robot);

  void startClock(Stamp) override {}
  void step(Stamp now, double step_s, const Physics& physics, SensorSuite& sensors,
            const SceneState& scene) override;
  void show(SceneState& state, Stamp now) const override;
  void tell(Truth& truth) const override;

 private:
  /// One brick's way from rest to rest.
  struct Watch {
    std::optional<Eigen::Isometry3d> X_map_rest;  ///< where it lay last, or was let go
    double rest_s = 0.0;
    bool held = false;
    int falls = 0;
  };
  void watch(std::size_t brick, double step_s);
  [[nodiscard]] std::optional<BinPlace> binOf(const Eigen::Isometry3d& X_map_brick) const;

  const TrueArena& arena_;
  const RobotGeometry& robot_;
  std::vector<BrickState> states_;
  std::vector<Watch> watches_;
  std::optional<std::size_t> held_;
  Eigen::Isometry3d X_map_base_ = Eigen::Isometry3d::Identity();
  std::vector<double> compartments_m_;
};

}  // namespace kiln::sim
