#include "common/wire/geometry.h"

#include <cmath>

namespace kiln::wire {

void toProto(const Eigen::Vector3d& p, v1::Vec3& out) {
  out.set_x_m(p.x());
  out.set_y_m(p.y());
  out.set_z_m(p.z());
}

void toProto(const Pose2& pose, v1::Pose2& out) {
  out.set_x_m(pose.x_m);
  out.set_y_m(pose.y_m);
  out.set_yaw_rad(pose.yaw_rad);
}

void toProto(const Twist2& twist, v1::Twist2& out) {
  out.set_vx_mps(twist.vx_mps);
  out.set_vy_mps(twist.vy_mps);
  out.set_wz_radps(twist.wz_radps);
}

void toProto(const Eigen::Isometry3d& X, v1::Pose3& out) {
  toProto(Eigen::Vector3d(X.translation()), *out.mutable_position());
  const Eigen::Quaterniond q(X.linear());
  out.set_qw(q.w());
  out.set_qx(q.x());
  out.set_qy(q.y());
  out.set_qz(q.z());
}

Eigen::Vector3d fromProto(const v1::Vec3& p) { return {p.x_m(), p.y_m(), p.z_m()}; }

Pose2 fromProto(const v1::Pose2& pose) { return {pose.x_m(), pose.y_m(), pose.yaw_rad()}; }

Twist2 fromProto(const v1::Twist2& twist) {
  return {twist.vx_mps(), twist.vy_mps(), twist.wz_radps()};
}

Result<Eigen::Isometry3d> fromProto(const v1::Pose3& X, const char* what) {
  constexpr double kUnitTolerance = 1e-3;
  const Eigen::Quaterniond q(X.qw(), X.qx(), X.qy(), X.qz());
  if (!(std::abs(q.norm() - 1.0) <= kUnitTolerance)) {
    return makeError(ErrorCode::InvalidInput, "{}: quaternion of length {} is no rotation; dropped",
                     what, q.norm());
  }
  Eigen::Isometry3d out = Eigen::Isometry3d::Identity();
  out.linear() = q.normalized().toRotationMatrix();
  out.translation() = fromProto(X.position());
  if (!isFinite(out))
    return makeError(ErrorCode::InvalidInput, "{}: position is not finite; dropped", what);
  return out;
}

}  // namespace kiln::wire
