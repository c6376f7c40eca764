#pragma once

#include <Eigen/Geometry>

namespace kiln {

using Vector6d = Eigen::Matrix<double, 6, 1>;

/// Pose on the ground plane. Radians, metres; yaw about +Z.
struct Pose2 {
  double x_m = 0.0;
  double y_m = 0.0;
  double yaw_rad = 0.0;
};

/// Velocity on the ground plane, expressed in the base frame.
struct Twist2 {
  double vx_mps = 0.0;
  double vy_mps = 0.0;
  double wz_radps = 0.0;
};

[[nodiscard]] double wrapAngle(double angle_rad);  ///< to (-pi, pi]
[[nodiscard]] Pose2 operator*(const Pose2& X_a_b, const Pose2& X_b_c);
[[nodiscard]] Pose2 inverse(const Pose2& X_a_b);
[[nodiscard]] Eigen::Isometry3d toIsometry(const Pose2& X_a_b);  ///< z = 0
[[nodiscard]] Pose2 projectToGround(const Eigen::Isometry3d& X_a_b);
/// From translation and roll-pitch-yaw (R = Rz(yaw) Ry(pitch) Rx(roll)).
[[nodiscard]] Eigen::Isometry3d makePose(const Eigen::Vector3d& p, const Eigen::Vector3d& rpy_rad);
/// X axis along `x_axis`, Z as near to `up` as possible. @pre x_axis is not zero and not parallel
/// to up.
[[nodiscard]] Eigen::Matrix3d frameFromXAndUp(const Eigen::Vector3d& x_axis,
                                              const Eigen::Vector3d& up);
[[nodiscard]] double rotationAngle(const Eigen::Isometry3d& X_a_b);  ///< radians, [0, pi]
[[nodiscard]] Eigen::Isometry3d interpolate(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b,
                                            double s);
[[nodiscard]] bool isFinite(const Eigen::Isometry3d& X_a_b);

}  // namespace kiln
