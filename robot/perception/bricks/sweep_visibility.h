#pragma once

#include <span>
#include <vector>

#include <Eigen/Geometry>

#include "common/config/config_archive.h"
#include "robot/perception/bricks/brick_poses.h"
#include "robot/perception/bricks/model_cloud.h"

namespace kiln {

/// A sweep before it is made: the LiDAR on its way.
struct PlannedSweep {
  std::vector<Eigen::Isometry3d> X_world_lidar;  ///< at evenly spaced instants; not empty
  double duration_s = 4.2;
};

/// How much of bricks a sweep is expected to show, before it is made: the faces that its LiDAR can
/// see past the other bricks (ModelCloudGenerator, from the middle of its way: it moves by
/// centimetres), and on each piece of them the returns that the beams will give, by its solid angle
/// and for how long it lies between the uppermost and the lowest laser. Of one hypothesis where the
/// bricks lie; returns of several sweeps add up. Confined to one thread.
class SweepVisibility {
 public:
  struct Config {
    double spacing_m = 0.05;  ///< lattice on the faces; coarser than perception's own
    double rate_hz = 10.0;    ///< VLP-16: revolutions, columns of one, lasers 2 deg apart
    int columns = 1800;
    double half_fov_deg = 16.0;  ///< above and below its horizon: 15, and half a spacing
    double laser_spacing_deg = 2.0;
    double max_range_m = 12.0;  ///< beyond it a brick is only a few points
    void visit(ConfigArchive& a);
  };
  /// @param bricks  what is expected; what is not wanted hides others all the same.
  SweepVisibility(const Config& config, std::vector<ModelBrick> bricks);

  /// Expected returns of each piece of surface, bricks and faces in order; hidden ones 0.
  [[nodiscard]] std::vector<float> returnsOf(const PlannedSweep& sweep);
  /// Of each brick the surface cells of perception (kCell_m square) that get at least one return:
  /// the sum of 1 - exp(-returns). @param returns  of one sweep, or the sum of several.
  [[nodiscard]] std::vector<double> cellsFound(std::span<const float> returns) const;
  [[nodiscard]] std::size_t pieces() const { return areas_m2_.size(); }
  [[nodiscard]] const std::vector<ModelBrick>& bricks() const { return world_.bricks; }

  static constexpr double kCell_m = 0.02;  ///< ModelCloudGenerator's default, which perception uses

 private:
  [[nodiscard]] double returnsOn(const ModelPoint& point, double area_m2,
                                 const PlannedSweep& sweep) const;
  Config config_;
  ModelWorld world_;
  ModelCloudGenerator model_;
  std::vector<std::size_t> first_;  ///< by brick, into areas_m2_; one more at the end
  std::vector<double> areas_m2_;    ///< by piece
};

/// So many cells of a brick must be found for its pose to be trusted: those that bring the
/// confidence of BrickPoseEstimator to 0.7 when everything else is in order, and half as many again.
[[nodiscard]] double cellsNeeded(const BrickPoseEstimator::Config& config);

}  // namespace kiln
