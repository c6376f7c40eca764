#pragma once

#include <memory>
#include <span>
#include <vector>

#include <Eigen/Geometry>

#include "common/core/error.h"
#include "common/model/sensor.h"
#include "robot/localization/scan_surfels.h"
#include "robot/localization/surfel_map.h"

namespace kiln {

/// Pose of the base found by registering one LiDAR scan with a surfel map.
struct ScanMatch {
  Stamp stamp;                                                   ///< of the scan
  Eigen::Isometry3d X_map_base = Eigen::Isometry3d::Identity();  ///< at `stamp`
  Eigen::Matrix<double, 6, 6> covariance =
      Eigen::Matrix<double, 6, 6>::Identity();  ///< of (x y z m, roll pitch yaw rad) in map, about
                                                ///< the base; large where nothing was observed
  int observable_directions = 0;                ///< 0..6; along the others the prior was kept
  double inlier_fraction = 0.0;  ///< of the patches that are not floor: explained by the map
  double rms_m = 0.0;            ///< of the inliers, along the map's normals
  int iterations = 0;
  int points = 0;  ///< patches used
};

/// Registers scans with a surfel map by probabilistic assignment: each patch of the scan is
/// shared among the map's surfels near it and an outlier class, finest known level first; Gauss-
/// Newton on SE(3) moves the base, assignments and levels are refined from coarse to fine
/// (Droeschel and Behnke, ICRA 2018). The scan's upright edges are drawn to the map's posts.
/// Directions that no surface holds (a corridor) are found from the eigenvalues of the information
/// and left at the prior.
///
/// Thread-compatible; const calls from several threads are safe. Cost: tests/bench/localization.
class ScanMatcher {
 public:
  struct Config {
    double patch_m = 0.2;  ///< scan cells
    int max_patches = 1600;
    int min_patches = 100;  ///< fewer: Degenerate
    double max_range_m = 40.0;
    double sensor_sigma_m = 0.012;  ///< of a patch: lasers differ by a fixed bias
    double inlier_distance_m = 0.05;
    double min_inlier_fraction = 0.35;  ///< below: the pose is not believed
    int max_edges = 160;                ///< ends of surfaces, matched with the map's posts
    double min_information = 5.0;       ///< effective patches that must hold a direction
    double residual_sigma_m = 0.10;     ///< a patch's weight in the covariance; above the sensor's
                                        ///< noise because errors are correlated
    double floor_sigma_m = 0.008;       ///< never believe more than this (map, extrinsics)
    double floor_sigma_deg = 0.12;
    double search_radius_m = 1.0;
    double search_angle_deg = 20.0;
    double search_step_m = 0.2;
    double search_step_deg = 2.5;
    int search_patches = 250;        ///< looked at for each candidate pose
    int search_candidates = 12;      ///< refined
    double ambiguity_margin = 0.92;  ///< another place explained this well, relative: ambiguous
    void visit(ConfigArchive& a);
  };

  /// @pre map is not null and refresh() has been called on it.
  ScanMatcher(Config config, std::shared_ptr<const SurfelMap> map);

  /// @param scan_base  undistorted, self-filtered, in `base` at scan.stamp; NaN points are skipped.
  /// @param X_map_base_prior  good to about 0.3 m and 5 deg, roll and pitch included.
  /// @param p_base_sensor  LiDAR centre in base, metres: which side of a wall is seen. The default
  ///                       is that of the driving pose; half a metre off does no harm.
  /// @return Error{Degenerate} if there are too few points, the map explains too few of them, or
  ///         no direction is held; Error{InvalidInput} if the prior is not finite.
  [[nodiscard]] Result<ScanMatch> match(
      const PointCloud& scan_base, const Eigen::Isometry3d& X_map_base_prior,
      const Eigen::Vector3d& p_base_sensor = kDrivingSensor) const;
  /// The same from a prior good to search_radius_m and search_angle_deg about Z; height, roll and
  /// pitch as for match(). Error{Degenerate} also if two different places explain the scan alike.
  [[nodiscard]] Result<ScanMatch> search(
      const PointCloud& scan_base, const Eigen::Isometry3d& X_map_base_prior,
      const Eigen::Vector3d& p_base_sensor = kDrivingSensor) const;

  [[nodiscard]] const Config& config() const { return config_; }
  [[nodiscard]] const SurfelMap& map() const { return *map_; }

  static inline const Eigen::Vector3d kDrivingSensor{0.55, 0.0, 1.45};

 private:
  /// What registration needs of a scan.
  struct Scan {
    std::vector<ScanSurfel> patches;
    std::vector<ScanEdge> edges;
    [[nodiscard]] Scan thinned(int max_patches) const;
  };
  struct Stage {
    int level;
    double spread_m;  ///< added to the surfels' thickness: how far a patch may look
    int iterations;
  };
  struct Equations;
  struct Directions;
  struct Share;
  [[nodiscard]] Result<Scan> prepare(const PointCloud& scan_base,
                                     const Eigen::Isometry3d& X_map_base_prior,
                                     const Eigen::Vector3d& p_base_sensor) const;
  [[nodiscard]] Share assign(const Eigen::Vector3f& p_map, const Eigen::Vector3f& view, int level,
                             float spread_m) const;
  [[nodiscard]] Equations linearise(const Scan& scan, const Eigen::Isometry3d& X_map_base,
                                    const Stage& stage) const;
  void addEdges(const std::vector<ScanEdge>& edges, const Eigen::Isometry3d& X_map_base,
                const Stage& stage, Equations& equations) const;
  [[nodiscard]] Directions directions(const Equations& equations) const;
  /// Iterates one stage; along directions that `held` leaves out the pose stays.
  void iterate(const Scan& scan, const Stage& stage, const Directions* held, ScanMatch& match,
               Equations& equations) const;
  /// Runs the stages; sets pose, iterations and what follows from the last equations.
  [[nodiscard]] ScanMatch refine(const Scan& scan, const Eigen::Isometry3d& start,
                                 std::span<const Stage> stages) const;
  void conclude(const Directions& directions, ScanMatch& match) const;
  void countInliers(std::span<const ScanSurfel> patches, ScanMatch& match) const;
  [[nodiscard]] Result<ScanMatch> judged(ScanMatch match, Stamp stamp) const;
  [[nodiscard]] double score(std::span<const ScanSurfel> patches,
                             const Eigen::Isometry3d& X_map_base) const;
  [[nodiscard]] std::vector<Eigen::Isometry3d> candidates(std::span<const ScanSurfel> patches,
                                                          const Eigen::Isometry3d& prior) const;

  Config config_;
  std::shared_ptr<const SurfelMap> map_;
};

}  // namespace kiln
