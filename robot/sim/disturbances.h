#pragma once

#include <optional>

#include "robot/sim/fault_script.h"
#include "robot/sim/physics.h"
#include "robot/sim/scene_state.h"
#include "robot/sim/walkers.h"

namespace kiln::sim {

/// Scripted things that make localisation hard: the robot is carried off, the cupboard is moved,
/// people walk or stand in the way, boards hide half the view. Thread-compatible.
class Disturbances {
 public:
  Disturbances(const TrueArena& arena, const RobotGeometry& robot, std::uint64_t seed);
  /// Before each physics step.
  void step(const FaultScript& faults, Stamp now, double step_s, Physics& physics);
  /// What the sensors see of it.
  void show(SceneState& state) const;
  [[nodiscard]] const std::vector<Pose2>& kidnaps() const { return kidnaps_; }  ///< where to
  [[nodiscard]] const std::optional<MovedBox>& moved() const { return moved_; }

 private:
  void kidnap(const FaultScript& faults, Stamp now, Physics& physics);
  void moveCupboard(const FaultConfig* fault, Physics& physics);
  void walk(const FaultConfig* fault, double step_s, const Physics& physics);
  void stepInWay(const FaultConfig* fault, double step_s);

  TrueArena arena_;
  RobotGeometry robot_;
  std::uint64_t seed_;
  std::vector<bool> kidnapped_;  ///< by fault
  std::vector<Pose2> kidnaps_;
  std::optional<std::size_t> cupboard_;  ///< index in arena.boxes
  std::optional<MovedBox> moved_;
  std::optional<Walkers> walkers_;
  struct Bystander {
    Eigen::Vector2d from, p;
  };
  std::optional<Bystander> bystander_;
  std::optional<double> board_azimuth_rad_;
};

}  // namespace kiln::sim
