#pragma once

#include <span>
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
    /// Beside the robot's outline a beam straddles it and what lies behind: such mixed pixels float
    /// between both. So many neighbours of a point on the robot, in its ring, are taken too when
    /// they are less than mixing_depth_m behind it.
    int edge_columns = 2;
    double mixing_depth_m = 0.7;
    void visit(ConfigArchive& a);
  };
  struct Output {
    PointCloud cloud;         ///< same stamp, frame and per-point times; order kept
    std::size_t removed = 0;  ///< points on the robot and mixed pixels at its outline
    std::size_t invalid = 0;  ///< NaN points, dropped too
  };
  SelfFilter(const RobotGeometry& geometry, Config config);
  /// @param scan  in `lidar`.
  /// @param arm   joint angles around the scan's time; if empty only NaN points are dropped.
  /// @param held   what the gripper holds (a brick), as boxes in `tool`.
  [[nodiscard]] Output filter(const PointCloud& scan, const ArmTrack& arm,
                              std::span<const BoxConfig> held = {}) const;

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
  [[nodiscard]] Body bodyAt(const Vector6d& q, std::span<const BoxConfig> held) const;
  /// Marks the points on the robot, then its mixed neighbours.
  [[nodiscard]] std::vector<bool> ownPoints(const PointCloud& scan, const std::vector<Body>& bodies,
                                            float duration_s) const;
  void markEdges(const PointCloud& scan, std::vector<bool>& own) const;
  [[nodiscard]] static bool contains(const Body& body, const Eigen::Vector3f& p);

  RobotGeometry geometry_;
  Config config_;
  Eigen::Isometry3d X_base_armbase_, X_lidar_flange_;
};

}  // namespace kiln
