#pragma once

#include <vector>

#include <Eigen/Geometry>

#include "common/model/sensor.h"
#include "common/robot_model/robot_geometry.h"
#include "robot/perception/cloud/arm_track.h"

namespace kiln {

/// Takes the robot's own body out of a scan: arm links as capsules, head and body as boxes, each
/// grown by a margin and placed where the joints were when the point was measured (the scan is cut
/// into slices of equal duration). Thread-compatible; keeps no state between calls. Cost:
/// tests/bench/cloud_bench.
class SelfFilter {
 public:
  struct Config {
    double margin_m = 0.06;  ///< noise, mixed pixels at edges, hose
    int slices = 8;          ///< of the scan's duration, for the moving arm
    void visit(ConfigArchive& a);
  };
  struct Output {
    PointCloud cloud;         ///< same stamp, frame and per-point times; order kept
    std::size_t removed = 0;  ///< points on the robot
    std::size_t invalid = 0;  ///< NaN points, dropped too
  };
  SelfFilter(const RobotGeometry& geometry, Config config);
  /// @param scan  in `lidar`.
  /// @param arm   joint angles around the scan's time; if empty only NaN points are dropped.
  [[nodiscard]] Output filter(const PointCloud& scan, const ArmTrack& arm) const;

 private:
  struct Capsule {
    Eigen::Vector3f a, along;  ///< start and vector to the end, in lidar
    float inverse_length2, radius2;
  };
  struct Box {
    Eigen::Matrix3f R;  ///< box axes from lidar axes
    Eigen::Vector3f t, half;
  };
  /// The robot as seen from the LiDAR at one instant.
  struct Body {
    std::vector<Capsule> capsules;
    std::vector<Box> boxes;
    float reach2 = 0.0f;  ///< nothing of the robot is farther from the LiDAR
  };
  [[nodiscard]] Body bodyAt(const Vector6d& q) const;
  [[nodiscard]] static bool contains(const Body& body, const Eigen::Vector3f& p);

  RobotGeometry geometry_;
  Config config_;
  Eigen::Isometry3d X_base_armbase_, X_lidar_flange_;
};

}  // namespace kiln
