#pragma once

#include <optional>

#include "common/robot_model/robot_geometry.h"
#include "robot/sim/physics.h"

namespace kiln::sim {

/// The scripted obstacle: a padded box of 0.2 m that appears in the way of the moving arm, a hand's
/// breadth clear of the head and touching nothing, so that the motion meets it at its own speed.
/// While the arm rests, or no free place lies on its way, it waits. Thread-compatible.
class ArmObstacle {
 public:
  explicit ArmObstacle(const RobotGeometry& robot) : robot_(robot) {}
  /// Before each physics step. Once it stands it stays there until `on` ends.
  void step(bool on, Physics& physics);
  [[nodiscard]] const std::optional<Eigen::Vector3d>& center() const { return p_map_; }

 private:
  [[nodiscard]] std::optional<Eigen::Vector3d> ahead(const Physics& physics) const;

  const RobotGeometry& robot_;
  std::optional<Eigen::Vector3d> p_map_;
};

}  // namespace kiln::sim
