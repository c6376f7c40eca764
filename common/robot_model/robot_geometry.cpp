#include "common/robot_model/robot_geometry.h"

#include <cmath>

#include "common/core/units.h"

namespace kiln {

void PoseConfig::visit(ConfigArchive& a) {
  stated = true;  // a loader comes here only for what stands in its file
  a.field("xyz_m", xyz_m, "m", -1e3, 1e3, "position");
  a.field("rpy_deg", rpy_deg, "deg", -360, 360, "roll, pitch, yaw; R = Rz(yaw) Ry(pitch) Rx(roll)");
}

Eigen::Isometry3d PoseConfig::pose() const {
  return makePose({xyz_m[0], xyz_m[1], xyz_m[2]},
                  Eigen::Vector3d(rpy_deg[0], rpy_deg[1], rpy_deg[2]) * kDeg);
}

void BoxConfig::visit(ConfigArchive& a) {
  a.field("name", name, "for messages and drawing");
  a.section("center", center, "pose of the box centre");
  a.field("size_m", size_m, "m", 0.001, 1e3, "full lengths along x, y, z");
}

void ArmShapeConfig::visit(ConfigArchive& a) {
  a.field("name", name, "for messages");
  a.field("link", link, "", 0, 6, "moves with the DH frame behind this joint; 0: fixed in armbase");
  a.field("from_m", from_m, "m", -2, 2, "one end of its axis in that frame");
  a.field("to_m", to_m, "m", -2, 2, "the other end");
  a.field("radius_m", radius_m, "m", 0.001, 0.5, "");
}

Capsule ArmShapeConfig::capsule() const {
  return {{from_m[0], from_m[1], from_m[2]}, {to_m[0], to_m[1], to_m[2]}, radius_m};
}

void RobotGeometry::visit(ConfigArchive& a) {
  a.field("length_m", length_m, "m", 0.2, 5, "footprint along X");
  a.field("width_m", width_m, "m", 0.2, 5, "footprint along Y");
  a.field("wheel_radius_m", wheel_radius_m, "m", 0.02, 0.5, "nominal hub wheel radius");
  a.field("wheel_x_m", wheel_x_m, "m", 0.05, 2, "steering axes at +-x");
  a.field("wheel_y_m", wheel_y_m, "m", 0.05, 2, "steering axes at +-y");
  a.field("steer_limit_deg", steer_limit_deg, "deg", 45, 360, "each side");
  a.field("steer_rate_deg_s", steer_rate_deg_s, "deg/s", 1, 1000, "29 rpm (data sheet)");
  a.field("max_wheel_speed_mps", max_wheel_speed_mps, "m/s", 0.1, 10, "of each hub motor");
  a.field("max_decel_mps2", max_decel_mps2, "m/s2", 0.5, 10, "what the drives can brake with");
  a.list("body", body, "boxes fixed in base");
  a.section("X_base_armbase", X_base_armbase, "arm mount");
  a.section("X_flange_lidar", X_flange_lidar, "LiDAR");
  a.section("X_flange_thermal", X_flange_thermal, "thermal camera");
  a.section("X_flange_rgb", X_flange_rgb, "head camera");
  a.section("X_flange_nozzle", X_flange_nozzle, "nozzle exit, X along the jet");
  a.section("X_flange_tool", X_flange_tool, "magnet face");
  a.section("X_base_operatorcamera", X_base_operatorcamera, "rear-top camera for the operator");
  a.list("head", head, "boxes fixed in flange");
  a.list("arm_shapes", arm_shapes, "capsules of the arm and of what is fixed to it");
  a.list("storage", storage, "compartments that travel sideways, the front one first");
  a.field("q_park_deg", q_park_deg, "deg", -360, 360, "arm folded above the deck");
  a.field("q_drive_deg", q_drive_deg, "deg", -360, 360, "LiDAR upright and clear");
}

Vector6d RobotGeometry::radians(const std::vector<double>& q_deg) {
  Vector6d q;
  for (int i = 0; i < 6; ++i) q[i] = q_deg[static_cast<std::size_t>(i)] * kDeg;
  return q;
}

Eigen::Isometry3d RobotGeometry::X_base_flange(const Vector6d& q) const {
  return X_base_armbase.pose() * arm.forward(q);
}

std::vector<Capsule> RobotGeometry::armCapsules(const Vector6d& q,
                                                const Eigen::Isometry3d& X_frame_armbase) const {
  const auto frames = arm.frames(q);
  std::vector<Capsule> out;
  out.reserve(arm_shapes.size());
  for (const ArmShapeConfig& shape : arm_shapes) {
    const Eigen::Isometry3d X =
        shape.link == 0 ? X_frame_armbase
                        : X_frame_armbase * frames[static_cast<std::size_t>(shape.link - 1)];
    out.push_back(shape.capsule().in(X));
  }
  return out;
}

}  // namespace kiln
