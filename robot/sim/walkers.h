#pragma once

#include <vector>

#include "robot/sim/random.h"
#include "robot/sim/true_arena.h"

namespace kiln::sim {

/// People who walk between places drawn by seed, around walls and furniture, and step aside for the
/// robot. Seen by the sensors, never touched: they are not in the physics. Thread-compatible.
class Walkers {
 public:
  Walkers(const TrueArena& arena, std::uint64_t seed, std::size_t count);
  /// @param p_robot centre of the robot in the plane of map.
  void step(double step_s, const Eigen::Vector2d& p_robot);
  [[nodiscard]] std::vector<Eigen::Vector3d> feet() const;  ///< on the ground, in map

 private:
  struct Walker {
    Random random;
    Eigen::Vector2d p = Eigen::Vector2d::Zero(), goal = Eigen::Vector2d::Zero();
    double rest_s = 0.0;
  };
  [[nodiscard]] bool free(const Eigen::Vector2d& p) const;
  [[nodiscard]] bool freeLine(const Eigen::Vector2d& from, const Eigen::Vector2d& to) const;
  [[nodiscard]] Eigen::Vector2d drawPoint(Random& random) const;
  void chooseGoal(Walker& walker) const;
  void move(Walker& walker, double step_s, const Eigen::Vector2d& p_robot) const;

  struct Footprint {
    Eigen::Isometry3d X_box_map;
    Eigen::Vector2d half;
  };
  std::vector<Footprint> footprints_;
  GroundProfile ground_;
  std::vector<Walker> walkers_;
};

}  // namespace kiln::sim
