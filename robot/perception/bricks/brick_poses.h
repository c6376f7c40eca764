#pragma once

#include <string_view>
#include <vector>

#include "common/core/clock.h"
#include "robot/perception/bricks/beam_evidence.h"
#include "robot/perception/bricks/brick_blocks.h"
#include "robot/perception/bricks/brick_sweep.h"
#include "robot/perception/bricks/model_cloud.h"
#include "robot/perception/bricks/rough_pose.h"

namespace kiln {

enum class BrickState : std::uint8_t {
  Found,      ///< lies where it should, upright
  Uncertain,  ///< something is there, but it does not fit well enough to be gripped
  Tilted,     ///< leans by more than a magnet gripper can take
  Missing,    ///< beams go through the place
  Fallen,     ///< missing, and a body of its size lies loose nearby
  Unseen,     ///< too little of it is in sight to say
  Excluded,   ///< not asked for
};
[[nodiscard]] std::string_view toString(BrickState state);

/// What a sweep says of one brick.
struct BrickEstimate {
  int id = 0;
  BrickKind kind = BrickKind::Red;
  BrickState state = BrickState::Unseen;
  Eigen::Isometry3d X_base_brick = Eigen::Isometry3d::Identity();
  Eigen::Matrix4d covariance = Eigen::Matrix4d::Identity();  ///< x, y, z, yaw; level axes, m, rad
  double confidence = 0.0;   ///< 0..1 that it lies as X_base_brick says, within 5 cm
  double found_share = 0.0;  ///< found of expected: the paper's confidence
  double tilt_rad = 0.0;     ///< against upright; of bricks that are there
  SurfaceEvidence evidence;
};

struct BrickPoses {
  std::vector<BrickEstimate> bricks;  ///< in the target's order
  int iterations = 0;
  double iteration_ms = 0.0, solve_ms = 0.0;  ///< mean of an outer iteration, of its solve
};

/// Poses of individual bricks, from a target's rough pose and one sweep: yaw and translation of
/// each, point-to-plane with correspondences of its own, weighted by 1/M(j), held together by E^R
/// and E^T where bricks touch, the lowest layer by the ground (NimbRo UGV paper, "Individual Brick
/// Pose Estimation"). What differs from the paper:
/// - correspondences are looked up from the measured point to the visible cell of the nearest face,
///   with the model's exact normals; all measured points count, not only those nearest to a model
///   point;
/// - where the LiDAR sees past an edge, the outline holds the brick along its faces;
/// - a brick that is found missing is taken out and the rest solved again;
/// - the confidence asks the beams (found, empty, hidden), the covariance and the tilt.
/// Config::paper() switches them off. Confined to one thread.
class BrickPoseEstimator {
 public:
  struct Config {
    bool nearest_neighbours = false;  ///< the paper's correspondences and measured normals
    bool use_outline = true;
    std::vector<double> distances_m{0.12, 0.06, 0.035};  ///< lambda_dist, stage by stage
    double min_cosine = 0.75;                            ///< lambda_dot
    double lateral_m = 0.025;                            ///< beside a face: still its point
    int max_iterations = 20;                             ///< over all stages
    int max_correspondences = 300;                       ///< of a brick; of more every n-th
    double touch_m = 0.02;                               ///< nearer bricks touch
    PairStiffness stiffness{0.0003, {0.01, 0.01, 0.15}};
    PairStiffness hold{2e-5, Eigen::Vector3d::Constant(3e-4)};  ///< of the start, for all bricks
    double min_weight = 60.0;      ///< M(j) at least: a brick of few points leans on its neighbours
    double ground_weight = 30.0;   ///< of the lowest layer's height
    double outline_weight = 20.0;  ///< of one stretch of outline
    int min_expected = 40;         ///< cells in sight; fewer: unseen
    double max_shift_m = 0.2;      ///< from the start; more: not this brick
    double max_turn_deg = 18.0;
    double max_tilt_deg = 4.0;
    double min_found = 0.5;  ///< of the cells; less: uncertain
    /// Covariance: of one point, of touching bricks (yaw, x, y, z), of a brick that nothing holds.
    double sigma_m = 0.06;
    double touch_sigma_deg = 1.5, touch_sigma_m = 0.01, touch_sigma_up_m = 0.003;
    double start_sigma_m = 0.08, start_sigma_deg = 10.0;
    double trust_sigma_m = 0.015;  ///< a larger one lowers the confidence
    BeamGates gates;
    SolveLimits solve;
    void visit(ConfigArchive& a);
    /// The paper's own method, for comparison on the same sweeps.
    [[nodiscard]] static Config paper();
  };
  /// @param clock  for the times in the result; nullptr: they are zero.
  explicit BrickPoseEstimator(const Config& config, const Clock* clock = nullptr);

  /// @param X_level_target  rough pose, upright.
  /// @return one estimate a brick of the target. Error{Degenerate}: nothing of any brick is in
  ///         sight.
  [[nodiscard]] Result<BrickPoses> estimate(const PreparedSweep& sweep, const BrickTarget& target,
                                            const Eigen::Isometry3d& X_level_target);
  [[nodiscard]] const Config& config() const { return config_; }

 private:
  Config config_;
  const Clock* clock_;
  ModelCloudGenerator model_;
};

}  // namespace kiln
