#pragma once

#include "robot/evaluation/marker/marker_yard.h"
#include "robot/perception/marker/marker_localizer.h"

namespace kiln {

/// A robot that looks at a yard for 10 s: it drives, its arm turns the head to and fro; sensors and
/// odometry have the errors of scenario.md section 2 (mountings of camera and LiDAR N(0, 5 mm),
/// N(0, 0.3 deg) each axis, never told to the perception).
class MarkerTrial {
 public:
  struct Step {
    RgbImage image;
    PointCloud scan_base;  ///< by the nominal mounting
    MarkerViewpoint from;  ///< all but the ground: nominal mounting, odometry
    Pose2 X_map_base;      ///< the truth, for judging alone
    Eigen::Isometry3d X_base_wall = Eigen::Isometry3d::Identity();  ///< likewise
  };
  MarkerTrial(const MarkerYard& yard, const RobotGeometry& robot, std::uint64_t seed);
  /// @param share  of the 10 s, 0 to 1; of one trial in rising order.
  [[nodiscard]] Step at(double share);

 private:
  [[nodiscard]] Vector6d posture(double share) const;
  [[nodiscard]] Pose2 basePose(double share) const;

  MarkerYard yard_;
  RobotGeometry nominal_;
  MarkerPainter painter_;
  Eigen::Isometry3d X_flange_rgb_, X_flange_lidar_;  // true
  double pan_phase_ = 0.0;
  double odometry_scale_ = 1.0, odometry_turn_rad_ = 0.0, odometry_yaw_per_m_ = 0.0;
};

}  // namespace kiln
