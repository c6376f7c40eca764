#pragma once

#include <string>
#include <vector>

#include "common/core/clock.h"
#include "robot/evaluation/bricks/sweep_synthesis.h"
#include "robot/perception/bricks/brick_perception.h"

namespace kiln {

enum class TrialKind : std::uint8_t { Pile, Lab, Wall };

struct TrialOptions {
  TrialKind kind = TrialKind::Pile;
  double disturbed = 0.0;  ///< share of the bricks on top that are missing, fallen or tilted
  double prior_m = 0.25, prior_deg = 6.0;  ///< how wrong the target's expected pose may be
  std::size_t max_bricks = 20;             ///< of interest; the others are excluded
  double reach_m = 2.2;                    ///< from the LiDAR's place along the line
  SweepSensor sensor;
};

/// A sweep with its truth.
struct BrickTrial {
  BrickScene scene;
  Eigen::Isometry3d X_world_base = Eigen::Isometry3d::Identity();
  BrickTarget target;  ///< what the robot knows
  BrickSweep sweep;
  double distance_m = 0.0;  ///< from the LiDAR to the front of the bricks
};
[[nodiscard]] BrickTrial makeTrial(const TrialOptions& options, std::uint64_t seed);

/// One brick of interest, believed against true.
struct BrickOutcome {
  int id = 0;
  BrickKind kind = BrickKind::Red;
  BrickFate fate = BrickFate::InPlace;
  BrickState state = BrickState::Unseen;
  double confidence = 0.0;
  bool there = false;                         ///< a brick is, at or near its place
  double error_m = 0.0, yaw_error_deg = 0.0;  ///< of the believed pose against that brick
  double normalised = 0.0;  ///< error over its one sigma by the covariance, position
  Eigen::Vector3d off_m = Eigen::Vector3d::Zero();  ///< along the brick's axes
  SurfaceEvidence evidence;
};
[[nodiscard]] std::vector<BrickOutcome> compare(const BrickTrial& trial, const BrickPoses& poses);

/// Believed against true pose of pile or wall: metres, degrees.
struct TargetError {
  double position_m = 0.0, yaw_deg = 0.0;
};
[[nodiscard]] TargetError compareTarget(const BrickTrial& trial,
                                        const Eigen::Isometry3d& X_base_target);

}  // namespace kiln
