#pragma once

#include <cstdint>
#include <optional>
#include <random>
#include <vector>

#include "common/config/config_archive.h"
#include "robot/planning/arm_motion/arm_collision.h"

namespace kiln {

/// What one question asks beyond its goals.
struct ArmPathDemand {
  std::optional<double> clearance_m;  ///< instead of the planner's own
  /// The flange keeps its tilt against the base's Z all the way, and turns about it alone: joint 6
  /// stands, joint 4 makes good what 2 and 3 turn. Goals that tilt it otherwise are left out.
  bool keep_tilt = false;
};

/// Joint-space path around obstacles: the straight move if it is free, else RRT-Connect (Kuffner
/// and LaValle 2000) from the start to several goals at once, then random short cuts. Done in
/// slices, so that a mission tick is never blocked; counted in iterations, not time, and seeded:
/// the same question has the same answer.
class ArmPlanner {
 public:
  struct Config {
    double clearance_m = 0.03;  ///< set by MoveArm, not from the file
    double step_rad = 0.35;     ///< longest tree edge, fastest joint
    int max_iterations = 3000;
    int shortcuts = 120;
    int seed = 1;
    void visit(ConfigArchive& a);
  };
  enum class Progress { Running, Found, Failed };

  /// @param collision must outlive the planner.
  ArmPlanner(const Config& config, const RobotGeometry& robot, const ArmCollision& collision);
  /// @param goals  postures free of collision, best first. Tries the straight moves at once.
  Progress start(const Vector6d& q_start, const std::vector<Vector6d>& goals,
                 const ArmPathDemand& demand = {});
  /// Up to `iterations` more of the search.
  Progress advance(int iterations);
  /// Corner postures, start and goal included. @pre Found.
  [[nodiscard]] const std::vector<Vector6d>& path() const { return path_; }
  [[nodiscard]] int iterations() const { return iterations_; }

 private:
  struct Node {
    Vector6d q;
    int parent;
  };
  using Tree = std::vector<Node>;
  enum class Grown { Trapped, Advanced, Reached };

  [[nodiscard]] Vector6d sample();
  Grown extend(Tree& tree, const Vector6d& target) const;
  [[nodiscard]] bool free(const Vector6d& a, const Vector6d& b) const;
  void join();
  void shorten();

  Config config_;
  Vector6d low_ = Vector6d::Zero(), high_ = Vector6d::Zero(), limit_;
  const ArmCollision& collision_;
  double clearance_m_ = 0.0;
  bool keep_tilt_ = false;
  std::mt19937 random_;
  Tree from_start_, from_goal_;
  bool grow_start_ = true;
  int iterations_ = 0;
  std::vector<Vector6d> path_;
};

}  // namespace kiln
