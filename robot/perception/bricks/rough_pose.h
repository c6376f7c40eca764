#pragma once

#include <optional>
#include <span>
#include <vector>

#include "robot/perception/bricks/brick_blocks.h"
#include "robot/perception/bricks/brick_sweep.h"
#include "robot/perception/bricks/model_cloud.h"

namespace kiln {

/// A brick as the database has it, relative to its pile or wall.
struct TargetBrick {
  int id = 0;
  BrickKind kind = BrickKind::Red;
  Eigen::Isometry3d X_target_brick = Eigen::Isometry3d::Identity();  ///< upright
  bool excluded = false;  ///< hides others, but its own pose is of no interest (far away)
};

/// Pile or wall with what is known of it before a sweep.
struct BrickTarget {
  std::vector<TargetBrick> bricks;
  Eigen::Isometry3d X_base_target = Eigen::Isometry3d::Identity();  ///< prior
  std::optional<Eigen::Vector3d> front_line{};  ///< direction of target X in base, by the marker
};

/// Where a pile or wall stands, as a whole.
struct RoughPose {
  Eigen::Isometry3d X_base_target = Eigen::Isometry3d::Identity();
  Eigen::Isometry3d X_level_target = Eigen::Isometry3d::Identity();  ///< upright
  Eigen::Matrix4d covariance = Eigen::Matrix4d::Identity();  ///< of x, y, z, yaw in level; m, rad
  double overlap = 0.0;    ///< of the model's points: have a measured one beside them
  double explained = 0.0;  ///< of the measured points around: have a model point beside them
  double rms_m = 0.0;      ///< of the correspondences, along the measured normals
  int correspondences = 0;
  int iterations = 0;
};

/// Aligns the model of a pile or wall, as a rigid whole, with a sweep: point-to-plane ICP with a
/// high correspondence distance, then point-to-point with a small one; E_dir where the marker gave
/// the front line's direction; Ceres with the paper's terminations (NimbRo UGV paper, "Rough
/// Pile/Wall Pose Estimation"). Upright: the ground says where up is and what height is zero.
/// Stacks that look alike are told apart by trying the model shifted along its X.
/// Confined to one thread.
class RoughPoseEstimator {
 public:
  struct Config {
    double far_m = 0.5, near_m = 0.15;  ///< correspondence distance of the first stage: from, to
    double close_m = 0.06;              ///< of the point-to-point stage
    double min_cosine = 0.6;            ///< of model and measured normal
    int max_iterations = 20;            ///< a stage
    int max_model_points = 900;         ///< used of the model cloud
    double shift_m = 0.5, shift_step_m = 0.1;  ///< tried along the target's X, each side
    double direction_weight = 10.0;            ///< of E_dir
    double ground_weight = 0.5;                ///< of the height over the ground, relative
    double hold = 0.02;        ///< of where a stage began: along a line of faces little else holds
    double min_overlap = 0.4;  ///< less: refused
    int min_correspondences = 80;  ///< fewer: refused
    double sigma_m = 0.15;         ///< of a correspondence: stacks are off by 5 cm, each as one
    SolveLimits solve;
    void visit(ConfigArchive& a);
  };
  explicit RoughPoseEstimator(const Config& config);

  /// @return Error{Degenerate}: too few points, or the sweep shows something else (of another
  ///         size, or elsewhere); Error{InvalidInput}: no brick to look for, prior not finite.
  [[nodiscard]] Result<RoughPose> estimate(const PreparedSweep& sweep, const BrickTarget& target);

  /// Where to look for a target in a sweep: its bricks and `margin_m` around them, the ground too.
  [[nodiscard]] static SweepRegion region(const BrickTarget& target, double margin_m);

 private:
  struct Search;
  Config config_;
  ModelCloudGenerator model_;
};

}  // namespace kiln
