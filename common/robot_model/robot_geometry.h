#pragma once

#include <array>
#include <string>
#include <vector>

#include "common/config/config_archive.h"
#include "common/geom/capsule.h"
#include "common/geom/pose.h"
#include "common/robot_model/storage_geometry.h"
#include "common/robot_model/ur_kinematics.h"

namespace kiln {

/// A fixed pose in a config file: metres and degrees in YAML, an isometry in code.
struct PoseConfig {
  std::vector<double> xyz_m{0, 0, 0};
  std::vector<double> rpy_deg{0, 0, 0};
  bool stated = false;  ///< a file or a calibration names it; else it is nothing but a default
  void visit(ConfigArchive& a);
  [[nodiscard]] Eigen::Isometry3d pose() const;
};

/// A box fixed in some frame.
struct BoxConfig {
  std::string name;
  PoseConfig center;
  std::vector<double> size_m{1, 1, 1};  ///< full lengths
  void visit(ConfigArchive& a);
};

/// A piece of the arm's hull: a capsule that moves with a link.
struct ArmShapeConfig {
  std::string name;
  /// 1 to 6: moves with the Denavit-Hartenberg frame behind that joint; 0: stands in `armbase`.
  int link = 0;
  std::vector<double> from_m{0, 0, 0}, to_m{0, 0, 0};  ///< ends of its axis in that frame
  double radius_m = 0.05;
  void visit(ConfigArchive& a);
  [[nodiscard]] Capsule capsule() const;
};

/// Nominal geometry of Bob: what the autonomy and the station believe. The simulator perturbs its
/// own copy. File: resources/robot_model/bob.yaml. Frames: common/geom/frames.h.
struct RobotGeometry {
  double length_m = 1.9, width_m = 1.4;  ///< footprint
  double wheel_radius_m = 0.085;
  double wheel_x_m = 0.70, wheel_y_m = 0.58;  ///< steering axes at (+-x, +-y)
  double steer_limit_deg = 180.0;
  double steer_rate_deg_s = 174.0;   ///< 29 rpm
  double max_wheel_speed_mps = 4.0;  ///< of each hub motor (paper: 4 m/s), at the ground
  double max_decel_mps2 = 2.5;       ///< what the drives' own stop brakes with
  std::vector<BoxConfig>
      body;  ///< deck, tanks, storage: in base; for collision, drawing, self filter
  PoseConfig X_base_armbase;
  PoseConfig X_flange_lidar, X_flange_thermal, X_flange_rgb, X_flange_nozzle, X_flange_tool;
  PoseConfig X_base_operatorcamera;
  std::vector<BoxConfig> head;             ///< end-effector boxes, in flange
  std::vector<ArmShapeConfig> arm_shapes;  ///< hull of the arm and of what is fixed to it
  std::vector<CompartmentConfig> storage;  ///< none: this robot stores nothing
  std::vector<double> q_park_deg{0, 0, 0, 0,
                                 0, 0};  ///< arm folded above the deck, for driving through doors
  std::vector<double> q_drive_deg{0, 0, 0, 0, 0, 0};  ///< LiDAR upright and clear, for driving
  UrKinematics arm = UrKinematics::ur10e();           ///< not in the file
  /// Measured minus true range of each laser, by ring; from a calibration, not in the file. Empty:
  /// none known.
  std::vector<double> lidar_range_bias_m;

  void visit(ConfigArchive& a);
  [[nodiscard]] static Vector6d radians(const std::vector<double>& q_deg);
  /// X_base_flange for joint angles q.
  [[nodiscard]] Eigen::Isometry3d X_base_flange(const Vector6d& q) const;
  /// arm_shapes for joint angles q, in their order, in the frame from which the arm is seen.
  [[nodiscard]] std::vector<Capsule> armCapsules(const Vector6d& q,
                                                 const Eigen::Isometry3d& X_frame_armbase) const;
};

}  // namespace kiln
