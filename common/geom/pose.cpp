#include "common/geom/pose.h"

#include <cmath>

namespace kiln {

double wrapAngle(double angle_rad) {
  const double wrapped = std::remainder(angle_rad, 2.0 * M_PI);
  return wrapped <= -M_PI ? M_PI : wrapped;
}

Pose2 operator*(const Pose2& X_a_b, const Pose2& X_b_c) {
  const double c = std::cos(X_a_b.yaw_rad);
  const double s = std::sin(X_a_b.yaw_rad);
  return {X_a_b.x_m + c * X_b_c.x_m - s * X_b_c.y_m, X_a_b.y_m + s * X_b_c.x_m + c * X_b_c.y_m,
          wrapAngle(X_a_b.yaw_rad + X_b_c.yaw_rad)};
}

Pose2 inverse(const Pose2& X_a_b) {
  const double c = std::cos(X_a_b.yaw_rad);
  const double s = std::sin(X_a_b.yaw_rad);
  return {-c * X_a_b.x_m - s * X_a_b.y_m, s * X_a_b.x_m - c * X_a_b.y_m, wrapAngle(-X_a_b.yaw_rad)};
}

Eigen::Isometry3d toIsometry(const Pose2& X_a_b) {
  Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
  X.translation() = Eigen::Vector3d(X_a_b.x_m, X_a_b.y_m, 0.0);
  X.linear() = Eigen::AngleAxisd(X_a_b.yaw_rad, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  return X;
}

Pose2 projectToGround(const Eigen::Isometry3d& X_a_b) {
  return {X_a_b.translation().x(), X_a_b.translation().y(),
          std::atan2(X_a_b.linear()(1, 0), X_a_b.linear()(0, 0))};
}

Eigen::Isometry3d makePose(const Eigen::Vector3d& p, const Eigen::Vector3d& rpy_rad) {
  Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
  X.translation() = p;
  X.linear() = (Eigen::AngleAxisd(rpy_rad.z(), Eigen::Vector3d::UnitZ()) *
                Eigen::AngleAxisd(rpy_rad.y(), Eigen::Vector3d::UnitY()) *
                Eigen::AngleAxisd(rpy_rad.x(), Eigen::Vector3d::UnitX()))
                   .toRotationMatrix();
  return X;
}

Eigen::Matrix3d frameFromXAndUp(const Eigen::Vector3d& x_axis, const Eigen::Vector3d& up) {
  const Eigen::Vector3d x = x_axis.normalized();
  const Eigen::Vector3d y = up.cross(x).normalized();
  Eigen::Matrix3d R;
  R.col(0) = x;
  R.col(1) = y;
  R.col(2) = x.cross(y);
  return R;
}

double rotationAngle(const Eigen::Isometry3d& X_a_b) {
  return Eigen::AngleAxisd(X_a_b.linear()).angle();
}

Eigen::Isometry3d interpolate(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b, double s) {
  Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
  X.translation() = (1.0 - s) * a.translation() + s * b.translation();
  X.linear() =
      Eigen::Quaterniond(a.linear()).slerp(s, Eigen::Quaterniond(b.linear())).toRotationMatrix();
  return X;
}

bool isFinite(const Eigen::Isometry3d& X_a_b) { return X_a_b.matrix().allFinite(); }

}  // namespace kiln
