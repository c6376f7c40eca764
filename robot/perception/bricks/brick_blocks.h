#pragma once

#include <array>
#include <span>
#include <vector>

#include <Eigen/Core>

namespace kiln {

/// Upright motion of one brick since its initial pose: yaw about its initial centre, then
/// translation. (theta rad, tx, ty, tz m), in the frame `level`.
using UprightMotion = Eigen::Vector4d;

/// Point p of a brick at its initial pose belongs to the plane through q with unit normal n.
struct Correspondence {
  Eigen::Vector3d p, q, n;
  double weight = 1.0;
};

/// How stiff two bricks that touch hold together, or one brick its initial pose; squares of residuals
/// per rad^2 and m^2.
struct PairStiffness {
  double yaw = 0.0;                                 ///< lambda_r
  Eigen::Vector3d shift = Eigen::Vector3d::Zero();  ///< lambda_t, along level's axes
};

/// The terms of one brick in E_multi (NimbRo UGV paper, "Individual Brick Pose Estimation"):
/// r_i = sqrt(w_i / M) n_i . (c + R(theta)(p_i - c) + t - q_i), M the sum of the weights or
/// `min_weight`, whichever is more. One cost block with analytic Jacobian. Its last four residuals
/// hold the initial pose, weakly: along a direction that no face holds the pair terms would let
/// stacks of slightly turned bricks slide away.
struct BrickBlock {
  static constexpr int kHoldResiduals = 4;
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  std::vector<Correspondence> correspondences;
  double min_weight = 1.0;
  PairStiffness hold;

  [[nodiscard]] int residuals() const {
    return static_cast<int>(correspondences.size()) + kHoldResiduals;
  }
  [[nodiscard]] double weightSum() const;
  /// @param residuals  one a correspondence, then those of `hold`: residuals() in all.
  /// @param jacobian   row-major, four columns; nullptr: not wanted.
  void evaluate(const double* motion, double* residuals, double* jacobian) const;
};

/// E^R and E^T of two bricks: brick a where brick b would carry it, had nothing moved between
/// them since their initial poses. |R(theta_a - theta_b) - I|_F and the translation of a against b,
/// taken at a's centre (the paper takes it at the base's origin, which mixes in the rotation).
struct PairBlock {
  static constexpr int kResiduals = 4;
  Eigen::Vector3d b_to_a = Eigen::Vector3d::Zero();  ///< between the initial centres
  PairStiffness stiffness;
  /// @param jacobian_a, jacobian_b  4 x 4 row-major; nullptr: not wanted.
  void evaluate(const double* motion_a, const double* motion_b, double* residuals,
                double* jacobian_a, double* jacobian_b) const;
};

/// Which bricks (by index) a pair joins.
struct BrickPair {
  std::size_t a = 0, b = 0;
  PairBlock block;
};

struct SolveSummary {
  int iterations = 0;
  double initial_cost = 0.0, final_cost = 0.0;
  bool converged = false;
};

/// The paper's: until the change of the parameters or of the cost is below these.
struct SolveLimits {
  double parameter_tolerance = 5e-8;  ///< lambda_T
  double function_tolerance = 1e-6;   ///< lambda_C
  int max_iterations = 20;
};

/// Minimises all blocks and pairs over the motions (Levenberg-Marquardt by Ceres, one thread, so
/// the same answer each time). Bricks without correspondences and pairs stay.
/// @pre blocks.size() == motions.size().
[[nodiscard]] SolveSummary solveBricks(std::span<const BrickBlock> blocks,
                                       std::span<const BrickPair> pairs,
                                       std::span<UprightMotion> motions, const SolveLimits& limits);

/// Covariance of each brick's motion, (theta, x, y, z), from the information of all blocks and
/// pairs together: pairs and the rest in units of one sigma.
/// @param sigma_m       of one correspondence of weight 1; correlated errors are in it.
/// @param pair_sigmas   yaw rad, x, y, z m: how well two touching bricks keep together.
/// @param prior_sigmas  of a brick that nothing holds.
[[nodiscard]] std::vector<Eigen::Matrix4d> brickCovariances(std::span<const BrickBlock> blocks,
                                                            std::span<const BrickPair> pairs,
                                                            std::span<const UprightMotion> motions,
                                                            double sigma_m,
                                                            const Eigen::Vector4d& pair_sigmas,
                                                            const Eigen::Vector4d& prior_sigmas);

}  // namespace kiln
