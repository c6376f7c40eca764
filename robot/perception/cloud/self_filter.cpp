#include "robot/perception/cloud/self_filter.h"

#include <algorithm>
#include <cmath>

namespace kiln {
namespace {

Eigen::Vector3f halfSize(const BoxConfig& box, double margin) {
  return (0.5 * Eigen::Vector3d(box.size_m[0], box.size_m[1], box.size_m[2]) +
          Eigen::Vector3d::Constant(margin))
      .cast<float>();
}

}  // namespace

void SelfFilter::Config::visit(ConfigArchive& a) {
  a.field("margin_m", margin_m, "m", 0, 0.5, "the robot's shapes are grown by this");
  a.field("slices", slices, "", 1, 100, "of a scan, each with its own joint angles");
}

SelfFilter::SelfFilter(const RobotGeometry& geometry, Config config)
    : geometry_(geometry),
      config_(config),
      X_base_armbase_(geometry.X_base_armbase.pose()),
      X_lidar_flange_(geometry.X_flange_lidar.pose().inverse()) {}

SelfFilter::Body SelfFilter::bodyAt(const Vector6d& q) const {
  Body body;
  const auto joints = geometry_.arm.frames(q);
  const Eigen::Isometry3d X_lidar_armbase = X_lidar_flange_ * joints[5].inverse();
  const auto addBox = [&](const BoxConfig& config, const Eigen::Isometry3d& X_lidar_parent) {
    const Eigen::Isometry3d X_box_lidar = (X_lidar_parent * config.center.pose()).inverse();
    Box box{X_box_lidar.linear().cast<float>(), X_box_lidar.translation().cast<float>(),
            halfSize(config, config_.margin_m)};
    const float far = box.t.norm() + box.half.norm();
    body.reach2 = std::max(body.reach2, far * far);
    body.boxes.push_back(box);
  };
  for (const BoxConfig& box : geometry_.head) addBox(box, X_lidar_flange_);
  for (const BoxConfig& box : geometry_.body)
    addBox(box, X_lidar_armbase * X_base_armbase_.inverse());

  Eigen::Vector3d previous = X_lidar_armbase.translation();
  for (std::size_t i = 0; i < joints.size(); ++i) {
    // A UR link leaves its joint sideways: the corner between two DH frames lies d along the
    // joint's axis.
    const Eigen::Isometry3d& parent = i == 0 ? Eigen::Isometry3d::Identity() : joints[i - 1];
    const Eigen::Vector3d corner =
        X_lidar_armbase * (parent * Eigen::Vector3d(0, 0, geometry_.arm.d[i]));
    const Eigen::Vector3d end = X_lidar_armbase * joints[i].translation();
    const double radius =
        geometry_.link_radius_m[std::min(i, geometry_.link_radius_m.size() - 1)] + config_.margin_m;
    for (const auto& [from, to] : {std::pair{previous, corner}, std::pair{corner, end}}) {
      const Eigen::Vector3f along = (to - from).cast<float>();
      const float length2 = along.squaredNorm();
      if (length2 < 1e-8f && i > 0) continue;
      body.capsules.push_back({from.cast<float>(), along, length2 > 1e-8f ? 1.0f / length2 : 0.0f,
                               static_cast<float>(radius * radius)});
      const double far = std::max(from.norm(), to.norm()) + radius;
      body.reach2 = std::max(body.reach2, static_cast<float>(far * far));
    }
    previous = end;
  }
  return body;
}

bool SelfFilter::contains(const Body& body, const Eigen::Vector3f& p) {
  for (const Box& box : body.boxes) {
    const Eigen::Vector3f local = (box.R * p + box.t).cwiseAbs();
    if (local.x() <= box.half.x() && local.y() <= box.half.y() && local.z() <= box.half.z())
      return true;
  }
  for (const Capsule& capsule : body.capsules) {
    const Eigen::Vector3f from = p - capsule.a;
    const float s = std::clamp(from.dot(capsule.along) * capsule.inverse_length2, 0.0f, 1.0f);
    if ((from - s * capsule.along).squaredNorm() <= capsule.radius2) return true;
  }
  return false;
}

SelfFilter::Output SelfFilter::filter(const PointCloud& scan, const ArmTrack& arm) const {
  Output out;
  out.cloud.stamp = scan.stamp;
  out.cloud.seq = scan.seq;
  out.cloud.frame = scan.frame;
  out.cloud.reserve(scan.size());
  const float duration =
      scan.size() == 0 ? 0.0f
                       : *std::max_element(scan.time_offset_s.begin(), scan.time_offset_s.end());
  const auto slices = static_cast<std::size_t>(std::max(1, config_.slices));
  std::vector<Body> bodies;
  for (std::size_t i = 0; i < slices && !arm.empty(); ++i) {
    const double middle = duration * (static_cast<double>(i) + 0.5) / static_cast<double>(slices);
    bodies.push_back(bodyAt(*arm.at(scan.stamp + fromSeconds(middle))));
  }
  const float slices_per_s = duration > 0 ? static_cast<float>(slices) / duration : 0.0f;
  for (std::size_t i = 0; i < scan.size(); ++i) {
    const Eigen::Vector3f p(scan.x[i], scan.y[i], scan.z[i]);
    const float range2 = p.squaredNorm();
    if (!std::isfinite(range2)) {
      ++out.invalid;
      continue;
    }
    if (!bodies.empty()) {
      const float slice =
          std::clamp(scan.time_offset_s[i] * slices_per_s, 0.0f, static_cast<float>(slices - 1));
      const Body& body = bodies[static_cast<std::size_t>(slice)];
      if (range2 <= body.reach2 && contains(body, p)) {
        ++out.removed;
        continue;
      }
    }
    out.cloud.push(p.x(), p.y(), p.z(), scan.intensity[i], scan.ring[i], scan.time_offset_s[i]);
  }
  return out;
}

}  // namespace kiln
