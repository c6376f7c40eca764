#include "robot/perception/calibration/robot_edges.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace kiln {
namespace {

constexpr double kBesideArm_m = 0.06;   // joints, hose, shadows beside the arm
constexpr double kBesideHead_m = 0.02;  // the wrist is part of the head's own picture

struct Solid {
  Eigen::Isometry3d X_base_box;
  Eigen::Vector3d half;
  bool head;
};

struct Rod {
  Eigen::Vector3d a, b;
  double radius;
  bool head;  // stands for the head as a whole
};

struct Robot {
  std::vector<Solid> boxes;
  std::vector<Rod> rods;
};

/// Does the segment from `from` to `to` pass through the box, its last centimetre left out?
bool passes(const Solid& box, const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  const Eigen::Vector3d a = box.X_base_box.inverse() * from, b = box.X_base_box.inverse() * to;
  const Eigen::Vector3d d = b - a;
  double enter = 0.0, leave = 1.0 - 0.01 / std::max(0.02, d.norm());
  for (int i = 0; i < 3; ++i) {
    if (std::abs(d[i]) < 1e-9) {
      if (std::abs(a[i]) > box.half[i]) return false;
      continue;
    }
    const double s = (-box.half[i] - a[i]) / d[i], t = (box.half[i] - a[i]) / d[i];
    enter = std::max(enter, std::min(s, t));
    leave = std::min(leave, std::max(s, t));
  }
  return enter < leave;
}

/// Least distance of two segments, sampled: the rods are thick.
bool passes(const Rod& rod, double margin_m, const Eigen::Vector3d& from,
            const Eigen::Vector3d& to) {
  const Eigen::Vector3d ray = (to - from).normalized();
  constexpr int kPieces = 12;
  for (int i = 0; i <= kPieces; ++i) {
    const Eigen::Vector3d p = rod.a + (rod.b - rod.a) * (static_cast<double>(i) / kPieces);
    const double along = (p - from).dot(ray);
    if (along < 0.0 || along > (to - from).norm()) continue;
    if ((p - from - along * ray).norm() < rod.radius + margin_m) return true;
  }
  return false;
}

Robot robotAt(const RobotGeometry& geometry, const Vector6d& q) {
  Robot out;
  const Eigen::Isometry3d X = geometry.X_base_armbase.pose();
  const auto frames = geometry.arm.frames(q);
  const auto add = [&out](const BoxConfig& box, const Eigen::Isometry3d& X_base_part, bool head) {
    const Eigen::Vector3d size(box.size_m[0], box.size_m[1], box.size_m[2]);
    out.boxes.push_back({X_base_part * box.center.pose(), 0.5 * size, head});
  };
  for (const BoxConfig& box : geometry.body) add(box, Eigen::Isometry3d::Identity(), false);
  for (const BoxConfig& box : geometry.head) add(box, X * frames[5], true);
  for (const Capsule& c : geometry.armCapsules(q, X))
    out.rods.push_back({c.a, c.b, c.radius, false});
  const Eigen::Vector3d tip = X * frames[5] * Eigen::Vector3d(0, 0, 0.25);
  out.rods.push_back({X * frames[5].translation(), tip, 0.16, true});
  return out;
}

bool hidden(const Robot& robot, bool on_head, const Eigen::Vector3d& p_camera,
            const Eigen::Vector3d& p) {
  return std::any_of(robot.boxes.begin(), robot.boxes.end(),
                     [&](const Solid& box) { return passes(box, p_camera, p); }) ||
         std::any_of(robot.rods.begin(), robot.rods.end(), [&](const Rod& rod) {
           if (on_head && rod.head) return false;
           return passes(rod, on_head ? kBesideHead_m : kBesideArm_m, p_camera, p);
         });
}

/// Points of one edge: along `axis`, on the given sides of the other two.
void sampleEdge(const Robot& robot, const Solid& box, int axis, double su, double sv,
                const Eigen::Vector3d& p_camera, double sample_m, std::vector<EdgePoint>& out) {
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;
  const int steps = std::max(2, static_cast<int>(2.0 * box.half[axis] / sample_m));
  for (int i = 1; i < steps; ++i) {
    Eigen::Vector3d local;
    local[axis] = box.half[axis] * (2.0 * i / steps - 1.0);
    local[u] = su * box.half[u];
    local[v] = sv * box.half[v];
    const Eigen::Vector3d p = box.X_base_box * local;
    // Seen when one of the two faces that meet here is turned to the camera.
    const Eigen::Vector3d view = box.X_base_box.linear().transpose() * (p_camera - p);
    if (su * view[u] <= 0.0 && sv * view[v] <= 0.0) continue;
    if (hidden(robot, box.head, p_camera, p)) continue;
    out.push_back({p, p + 0.01 * box.X_base_box.linear().col(axis)});
  }
}

}  // namespace

std::vector<EdgePoint> visibleEdges(const RobotGeometry& geometry, const Vector6d& q,
                                    const Eigen::Vector3d& p_base_camera, double sample_m) {
  const Robot robot = robotAt(geometry, q);
  std::vector<EdgePoint> out;
  for (const Solid& box : robot.boxes)
    for (int axis = 0; axis < 3; ++axis)
      for (const double su : {-1.0, 1.0})
        for (const double sv : {-1.0, 1.0})
          sampleEdge(robot, box, axis, su, sv, p_base_camera, box.head ? 0.5 * sample_m : sample_m,
                     out);
  return out;
}

}  // namespace kiln
