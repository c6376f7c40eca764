#pragma once

#include <optional>
#include <span>
#include <vector>

#include "common/core/clock.h"
#include "robot/perception/bricks/brick_correspondences.h"
#include "robot/perception/bricks/brick_poses.h"
#include "robot/perception/bricks/point_tree.h"

namespace kiln {

/// The bricks of one target while they are aligned with one sweep. Of BrickPoseEstimator alone.
class BrickAlignment {
 public:
  /// @param start  all bricks that hide each other; `free` says which of them may move.
  BrickAlignment(const BrickPoseEstimator::Config& config, const PreparedSweep& sweep,
                 ModelCloudGenerator& model, std::vector<ModelBrick> start, std::vector<bool> free,
                 const Clock* clock);

  /// Iterates over the stages that are not finer than `from_m`.
  void run(double from_m, int max_iterations);
  /// Takes bricks out of the world: they neither move nor hide any more.
  void remove(std::span<const std::size_t> bricks);
  /// Sees the world again where the bricks lie now.
  void render();

  [[nodiscard]] std::size_t size() const { return start_.size(); }
  [[nodiscard]] ModelBrick brick(std::size_t i) const;
  [[nodiscard]] std::vector<ModelBrick> bricksThere() const;
  [[nodiscard]] bool gone(std::size_t i) const { return gone_[i]; }
  [[nodiscard]] const UprightMotion& motion(std::size_t i) const { return motions_[i]; }
  [[nodiscard]] std::array<FaceGrid, 6> lattice(std::size_t i) const;
  [[nodiscard]] SurfaceEvidence evidence(std::size_t i) const;
  [[nodiscard]] std::vector<Eigen::Matrix4d> covariances() const;
  /// By measured point: a brick of ours, -1: none. After run().
  [[nodiscard]] std::vector<int> owners() const;
  /// Share of the expected points with a measured one beside it, by nearest neighbours.
  [[nodiscard]] double foundByNeighbours(std::size_t i) const;

  [[nodiscard]] int iterations() const { return iterations_; }
  [[nodiscard]] double seconds() const { return seconds_; }
  [[nodiscard]] double solveSeconds() const { return solve_seconds_; }

 private:
  void findPairs();
  void correspond(double distance_m);
  void addGround(std::size_t i, BrickBlock& block) const;
  void findOutlines();
  [[nodiscard]] double now() const;

  const BrickPoseEstimator::Config& config_;
  const PreparedSweep& sweep_;
  ModelCloudGenerator& model_;
  const Clock* clock_;
  std::vector<ModelBrick> start_;
  std::vector<bool> free_, gone_;
  std::vector<UprightMotion> motions_;
  std::vector<BrickPair> pairs_;
  std::vector<BrickBlock> blocks_;
  std::vector<std::vector<Correspondence>> outlines_;  ///< by brick, of this stage
  BeamIndex beams_;
  PointTree tree_;

  ModelCloud cloud_;                ///< of the bricks that are there
  std::vector<std::size_t> there_;  ///< index of each in start_
  std::optional<SurfaceAssignment> assignment_;
  int iterations_ = 0;
  double seconds_ = 0.0, solve_seconds_ = 0.0;
};

}  // namespace kiln
