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

/// A capsule this short is the barrel of a joint: drawn as such.
bool isBarrel(const Capsule& c) { return (c.b - c.a).norm() < 2.5 * c.radius; }

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
  for (const ArmShapeConfig& shape : geometry_.arm_shapes) {
    const Capsule c = shape.capsule();
    parts_.push_back({Form::Capsule,
                      isBarrel(c) ? Role::Joint : Role::Arm,
                      {c.radius, c.radius, (c.b - c.a).norm()}});
  }
  for (const BoxConfig& box : geometry_.head)
    parts_.push_back({Form::Box, Role::Head, sizeOf(box)});
  parts_.push_back({Form::Cylinder, Role::Nozzle, {kNozzleRadius, kNozzleRadius, kNozzleLength}});
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
  for (const Capsule& c : geometry_.armCapsules(q, geometry_.X_base_armbase.pose()))
    out.push_back(alongSegment(c.a, c.b));
  const Eigen::Isometry3d X_base_flange = geometry_.X_base_flange(q);
  for (const BoxConfig& box : geometry_.head) out.push_back(X_base_flange * box.center.pose());
  const Eigen::Isometry3d X_base_nozzle = X_base_flange * geometry_.X_flange_nozzle.pose();
  const Eigen::Vector3d exit = X_base_nozzle.translation();
  out.push_back(alongSegment(exit - kNozzleLength * X_base_nozzle.linear().col(0), exit));
  return out;
}

}  // namespace kiln::gui
