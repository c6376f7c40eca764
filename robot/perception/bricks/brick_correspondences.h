#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "robot/perception/bricks/brick_blocks.h"
#include "robot/perception/bricks/brick_sweep.h"
#include "robot/perception/bricks/model_cloud.h"

namespace kiln {

class PointTree;

/// lambda_dist, lambda_dot, and how far beside a face a point may lie.
struct CorrespondenceGates {
  double distance_m = 0.06, lateral_m = 0.025, min_cosine = 0.75;
};

/// Assigns measured points to bricks: each to the visible cell of the one face that is nearest,
/// within the gates. The correspondences are of the bricks where they lie now; `count` returns in
/// a leaf and a small residual give weight (Tukey).
class SurfaceAssignment {
 public:
  SurfaceAssignment(const PreparedSweep& sweep, std::span<const ModelBrick> bricks, double reach_m);
  /// @param lattice  visible cells by brick.
  /// @return by brick.
  [[nodiscard]] std::vector<std::vector<Correspondence>> assign(
      std::span<const ModelBrick> bricks, std::span<const std::array<FaceGrid, 6>> lattice,
      const CorrespondenceGates& gates);
  /// By measured point: the brick of the last assignment, -1: none.
  [[nodiscard]] std::span<const int> owners() const { return owners_; }

 private:
  struct Match {
    float cost = 1e9F;
    int face = -1;
  };
  [[nodiscard]] static Match match(const SurfacePoint& point, const Eigen::Isometry3f& X,
                                   const Eigen::Vector3f& size,
                                   const std::array<FaceGrid, 6>& lattice,
                                   const CorrespondenceGates& gates);
  const PreparedSweep& sweep_;
  std::vector<std::vector<std::uint32_t>> near_;  ///< by brick: points that may belong to it
  std::vector<int> owners_;
  std::vector<Match> matches_;
};

/// The paper's: for each model point the nearest measured one, within the gates, with the measured
/// normal. @return by brick.
[[nodiscard]] std::vector<std::vector<Correspondence>> nearestNeighbours(
    const PreparedSweep& sweep, const PointTree& tree, std::span<const ModelPoint> model,
    std::size_t bricks, const CorrespondenceGates& gates);

}  // namespace kiln
