#pragma once

#include <vector>

#include <Eigen/Core>

#include "common/core/error.h"
#include "common/model/sensor.h"
#include "robot/localization/wall_segments.h"

namespace kiln {

/// Pose of the base found from one LiDAR scan.
struct Alignment {
  Stamp stamp;                                               ///< of the scan
  Pose2 X_map_base;                                          ///< at `stamp`
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Identity();  ///< of (x m, y m, yaw rad) in map
  int observable_directions =
      0;           ///< 0..3; along the others the prior was kept and the covariance is large
  int points = 0;  ///< after thinning
  double inlier_fraction = 0.0;  ///< of `points`, nearer to a wall than the inlier distance
  double rms_m = 0.0;            ///< of the inliers
  int iterations = 0;
};

/// Aligns a LiDAR scan with the walls of the nominal arena map: where is the base?
///
/// Point to face in the plane (x, y, yaw) by Gauss-Newton with a Cauchy kernel whose gate shrinks.
/// Only `walls` are matched: furniture and fire boxes stand up to 15 cm off, people and what nobody
/// drew are outliers. Ends of faces pull too, so that the door holds Y while the robot still stands
/// outside. Directions in which the walls say nothing (a corridor) are left at the prior.
/// Thread-compatible; const calls from several threads are safe. Cost: about 1 ms a scan, the
/// search about 10 ms (tests/bench/localization).
class BoxMapAligner {
 public:
  struct Config {
    double z_min_m = 0.3;  ///< lower points are ground, feet, tables' shadows
    double z_max_m = 2.8;  ///< higher points are ceiling and wall crowns
    double max_range_m = 25.0;
    double voxel_m = 0.10;            ///< thinning cell: near walls must not outvote far ones
    int max_points = 2500;            ///< after thinning
    int min_points = 60;              ///< fewer wall points: Degenerate
    double coarse_gate_m = 0.6;       ///< first iterations after a search
    double track_gate_m = 0.30;       ///< first iterations while tracking
    double fine_gate_m = 0.12;        ///< last iterations
    double inlier_distance_m = 0.06;  ///< what counts as explained by a wall
    double min_inlier_fraction = 0.25;
    int max_iterations = 24;
    double min_information = 6.0;    ///< effective points that must hold a direction
    double residual_sigma_m = 0.10;  ///< a point's weight in the covariance; above the sensor's
                                     ///< noise because errors are correlated
    double floor_sigma_m = 0.008;    ///< never believe more than this (map and extrinsics)
    double floor_sigma_deg = 0.12;
    double search_radius_m = 0.45;  ///< first fix: half width of the search in x and y
    double search_angle_deg = 9.0;
    double search_step_m = 0.15;
    double search_step_deg = 3.0;
    void visit(ConfigArchive& a);
  };

  BoxMapAligner(Config config, const ArenaMap& arena);

  /// @param scan_base      points in `base` at scan.stamp: self-filtered, motion-compensated; NaN
  /// points are skipped.
  /// @param p_base_sensor  LiDAR centre in base, metres (which side of a wall is seen).
  /// @param X_map_base_prior  good to about 0.2 m and 4 deg.
  /// @return Error{Degenerate} if too few points or too few of them on walls; Error{InvalidInput}
  /// if the prior is not finite.
  [[nodiscard]] Result<Alignment> align(const PointCloud& scan_base,
                                        const Eigen::Vector3d& p_base_sensor,
                                        const Pose2& X_map_base_prior) const;
  /// The same from a prior that is only good to search_radius_m and search_angle_deg (start, reset,
  /// lost).
  [[nodiscard]] Result<Alignment> search(const PointCloud& scan_base,
                                         const Eigen::Vector3d& p_base_sensor,
                                         const Pose2& X_map_base_prior) const;

  [[nodiscard]] const Config& config() const { return config_; }

 private:
  using Points = std::vector<Eigen::Vector3d>;
  struct NormalEquations;
  [[nodiscard]] Result<Points> thin(const PointCloud& scan_base) const;
  [[nodiscard]] NormalEquations linearise(const Points& points,
                                          const std::vector<WallSegment>& visible,
                                          const Pose2& X_map_base, double gate_m) const;
  [[nodiscard]] Alignment refine(const Points& points, const Eigen::Vector3d& p_base_sensor,
                                 const Pose2& start, double first_gate_m) const;
  [[nodiscard]] double score(const Points& points, std::size_t stride,
                             const Eigen::Vector3d& p_base_sensor, const Pose2& X_map_base) const;
  [[nodiscard]] Result<Alignment> judged(Alignment alignment, Stamp stamp) const;
  [[nodiscard]] std::vector<Pose2> candidates(const Points& points,
                                              const Eigen::Vector3d& p_base_sensor,
                                              const Pose2& prior) const;

  Config config_;
  std::vector<WallSegment> segments_;
};

}  // namespace kiln
