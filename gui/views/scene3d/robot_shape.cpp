#include "gui/views/scene3d/robot_shape.h"

#include <cmath>

namespace kiln::gui {
namespace {

constexpr double kWheelWidth = 0.06;
constexpr double kNozzleRadius = 0.012, kNozzleLength = 0.10;

/// Local Z along the segment, origin in its middle.
Eigen::Isometry3d alongSegment(const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
  X.translation() = 0.5 * (from + to);
  if ((to - from).norm() > 1e-6) {
    X.linear() =
        Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), to - from).toRotationMatrix();
  }
  return X;
}

/// Arm base and the six joint frames' origins: what the links are strung along.
std::array<Eigen::Vector3d, 7> jointOrigins(const UrKinematics& arm, const Vector6d& q) {
  const auto X = arm.frames(q);
  std::array<Eigen::Vector3d, 7> p;
  p[0] = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < 6; ++i) p[i + 1] = X[i].translation();
  return p;
}

Eigen::Vector3d sizeOf(const BoxConfig& box) {
  return {box.size_m[0], box.size_m[1], box.size_m[2]};
}

}  // namespace

RobotShape::RobotShape(const RobotGeometry& geometry) : geometry_(geometry) {
  using Form = RobotPart::Form;
  using Role = RobotPart::Role;
  for (const BoxConfig& box : geometry_.body) {
    const bool tank = box.name.find("tank") != std::string::npos;
    parts_.push_back({Form::Box, tank ? Role::Tank : Role::Body, sizeOf(box)});
  }
  const double r = geometry_.wheel_radius_m;
  for (int i = 0; i < 4; ++i) parts_.push_back({Form::Cylinder, Role::Wheel, {r, r, kWheelWidth}});
  const auto p = jointOrigins(geometry_.arm, Vector6d::Zero());
  for (std::size_t i = 0; i < 6; ++i) {
    const double radius = geometry_.link_radius_m[i];
    parts_.push_back({Form::Capsule, Role::Arm, {radius, radius, (p[i + 1] - p[i]).norm()}});
  }
  for (std::size_t i = 0; i < 3; ++i) {  // barrels of shoulder, elbow and wrist 1, seen on every UR
    const double radius = 1.08 * geometry_.link_radius_m[i];
    parts_.push_back({Form::Cylinder, Role::Joint, {radius, radius, 2.3 * radius}});
  }
  for (const BoxConfig& box : geometry_.head)
    parts_.push_back({Form::Box, Role::Head, sizeOf(box)});
  parts_.push_back({Form::Cylinder, Role::Nozzle, {kNozzleRadius, kNozzleRadius, kNozzleLength}});
}

std::vector<Eigen::Isometry3d> RobotShape::armPoses(const Vector6d& q) const {
  const Eigen::Isometry3d X_base_armbase = geometry_.X_base_armbase.pose();
  const auto p = jointOrigins(geometry_.arm, q);
  const auto X = geometry_.arm.frames(q);
  std::vector<Eigen::Isometry3d> out;
  for (std::size_t i = 0; i < 6; ++i) out.push_back(X_base_armbase * alongSegment(p[i], p[i + 1]));
  for (std::size_t i = 0; i < 3; ++i)
    out.push_back(X_base_armbase * X[i]);  // Z is the next joint's axis
  return out;
}

std::vector<Eigen::Isometry3d> RobotShape::poses(const Vector6d& q,
                                                 const std::array<double, 4>& steer) const {
  std::vector<Eigen::Isometry3d> out;
  out.reserve(parts_.size());
  for (const BoxConfig& box : geometry_.body) out.push_back(box.center.pose());
  constexpr double kSignX[] = {1, 1, -1, -1}, kSignY[] = {1, -1, 1, -1};
  for (std::size_t i = 0; i < 4; ++i) {
    const Eigen::Vector3d hub(kSignX[i] * geometry_.wheel_x_m, kSignY[i] * geometry_.wheel_y_m,
                              geometry_.wheel_radius_m);
    out.push_back(
        makePose(hub, {M_PI / 2, 0.0, steer[i]}));  // cylinder axis across the rolling direction
  }
  for (const Eigen::Isometry3d& X : armPoses(q)) out.push_back(X);
  const Eigen::Isometry3d X_base_flange = geometry_.X_base_flange(q);
  for (const BoxConfig& box : geometry_.head) out.push_back(X_base_flange * box.center.pose());
  const Eigen::Isometry3d X_base_nozzle = X_base_flange * geometry_.X_flange_nozzle.pose();
  const Eigen::Vector3d exit = X_base_nozzle.translation();
  out.push_back(alongSegment(exit - kNozzleLength * X_base_nozzle.linear().col(0), exit));
  return out;
}

}  // namespace kiln::gui
