#pragma once

#include <vector>

#include <Eigen/Geometry>

#include "common/config/config_archive.h"
#include "common/core/error.h"
#include "common/model/sensor.h"
#include "robot/perception/cloud/pose_track.h"

namespace kiln {

/// The dense cloud that the arm makes by moving the LiDAR before a pile or a wall: every return
/// with the place from which it was measured, so that it also tells what is empty.
struct BrickSweep {
  std::vector<Eigen::Vector3f> points;   ///< base, metres
  std::vector<Eigen::Vector3f> origins;  ///< LiDAR centre at that moment, base; as long as points
  /// Puts one scan's returns where they were when they were measured; NaN points are left out.
  /// @param scan          in `lidar`, freed of the robot itself.
  /// @param X_base_lidar  over the scan; not empty.
  void add(const PointCloud& scan, const PoseTrack& X_base_lidar);
  /// The same of a scan that was put there already. @param scan_base  in `base`, with its times.
  void addPrepared(const PointCloud& scan_base, const PoseTrack& X_base_lidar);
  void add(const BrickSweep& other);  ///< of the same base
  [[nodiscard]] std::size_t size() const { return points.size(); }
};

/// Mean of the returns in one leaf, on a surface.
struct SurfacePoint {
  Eigen::Vector3f p = Eigen::Vector3f::Zero();
  Eigen::Vector3f n = Eigen::Vector3f::Zero();  ///< unit, towards the LiDAR; zero: unknown
  float count = 0.0F;                           ///< returns in the leaf
};

/// One return as a ray: free from `origin` up to `p`.
struct Beam {
  Eigen::Vector3f origin, p;
};

/// The ground around the target: n . p = d in base.
struct GroundFit {
  Eigen::Vector3d n = Eigen::Vector3d::UnitZ();  ///< unit, up
  double d_m = 0.0;
  double rms_m = 0.0;
  int points = 0;  ///< leaves within the tolerance
};

/// An upright box of space around the target.
struct SweepRegion {
  Eigen::Isometry3d X_base_region = Eigen::Isometry3d::Identity();
  Eigen::Vector3d low = Eigen::Vector3d::Zero(), high = Eigen::Vector3d::Zero();
};

/// A sweep as pose estimation uses it, in the frame `level`: on the ground below `base`, Z along
/// the ground's normal, X as near to the base's as that allows. A base that leans on its wheels,
/// and a LiDAR that is mounted a little askew, leave bricks upright in it.
struct PreparedSweep {
  Eigen::Isometry3d X_base_level = Eigen::Isometry3d::Identity();
  std::vector<SurfacePoint> surface;  ///< above the ground, within the region
  std::vector<Beam> beams;            ///< all that pass through the region, ground included
  Eigen::Vector3d p_level_sensor = Eigen::Vector3d::Zero();  ///< mean of the beams' origins
  GroundFit ground;
};

struct SweepPreparation {
  double leaf_m = 0.02;
  double ground_tolerance_m = 0.03;
  double ground_slope_deg = 8.0;  ///< of the ground in base, at most
  double ground_height_m = 0.3;   ///< of the ground below the region from z = 0 of base, at most
  double above_ground_m = 0.04;   ///< lower is ground
  double normal_radius_m = 0.05;
  int min_ground_points = 150;   ///< leaves; fewer: no ground
  int min_surface_points = 150;  ///< leaves; fewer: nothing to see
  void visit(ConfigArchive& a);
};

/// Crops, thins, finds and removes the ground (RANSAC with a fixed seed), and estimates normals
/// (NimbRo UGV paper, "Rough Pile/Wall Pose Estimation", steps 1 to 4).
/// @return Error{Degenerate} with the reason: too few points, no ground.
[[nodiscard]] Result<PreparedSweep> prepareSweep(const BrickSweep& sweep, const SweepRegion& region,
                                                 const SweepPreparation& config);

}  // namespace kiln
