#include "robot/perception/cloud/self_filter.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace kiln {
namespace {

constexpr double kTallest_m = 1.9;  ///< what stands in a bin reaches so far along its walls

Eigen::Vector3d sizeOf(const BoxConfig& box) {
  return {box.size_m[0], box.size_m[1], box.size_m[2]};
}

/// Of one compartment wherever it stands, with what is stored in it; in base.
struct SweptRow {
  Eigen::Isometry3d X_base_box;
  Eigen::Vector3d size_m;
};

SweptRow swept(const CompartmentConfig& row) {
  Eigen::AlignedBox3d hull;
  for (const CompartmentBox& box : row.boxes()) {
    const Eigen::Vector3d p = box.X_compartment_box.translation(), half = 0.5 * box.size_m;
    hull.extend(Eigen::AlignedBox3d(p - half, p + half));
  }
  hull.extend(Eigen::Vector3d(hull.center().x(), hull.min().y() + row.travel_min_m, kTallest_m));
  hull.extend(Eigen::Vector3d(hull.center().x(), hull.max().y() + row.travel_max_m, kTallest_m));
  return {row.X_base_compartment(0.0) * Eigen::Translation3d(hull.center()), hull.sizes()};
}

}  // namespace

void SelfFilter::Config::visit(ConfigArchive& a) {
  a.field("margin_m", margin_m, "m", 0, 0.5, "the robot's shapes are grown by this");
  a.field("slices", slices, "", 1, 100, "of a scan, each with its own joint angles");
  a.field("edge_columns", edge_columns, "", 0, 20, "mixed pixels beside the robot's outline");
  a.field("mixing_depth_m", mixing_depth_m, "m", 0, 5, "so far behind it they float");
}

SelfFilter::SelfFilter(const RobotGeometry& geometry, Config config)
    : geometry_(geometry),
      config_(config),
      X_base_armbase_(geometry.X_base_armbase.pose()),
      X_lidar_flange_(geometry.X_flange_lidar.pose().inverse()) {}

SelfFilter::Body SelfFilter::bodyAt(const Vector6d& q, std::span<const BoxConfig> held) const {
  Body body;
  const auto joints = geometry_.arm.frames(q);
  const Eigen::Isometry3d X_lidar_armbase = X_lidar_flange_ * joints[5].inverse();
  const auto add = [&](const Eigen::Isometry3d& X_lidar_box, const Eigen::Vector3d& size_m) {
    const Eigen::Isometry3d X_box_lidar = X_lidar_box.inverse();
    const Eigen::Vector3d half = 0.5 * size_m + Eigen::Vector3d::Constant(config_.margin_m);
    Box box{X_box_lidar.linear().cast<float>(), X_box_lidar.translation().cast<float>(),
            half.cast<float>()};
    const float far = box.t.norm() + box.half.norm();
    body.reach2 = std::max(body.reach2, far * far);
    body.boxes.push_back(box);
  };
  const auto addBox = [&](const BoxConfig& config, const Eigen::Isometry3d& X_lidar_parent) {
    add(X_lidar_parent * config.center.pose(), sizeOf(config));
  };
  for (const BoxConfig& box : geometry_.head) addBox(box, X_lidar_flange_);
  for (const BoxConfig& box : held) addBox(box, X_lidar_flange_ * geometry_.X_flange_tool.pose());
  for (const BoxConfig& box : geometry_.body)
    addBox(box, X_lidar_armbase * X_base_armbase_.inverse());
  for (const CompartmentConfig& row : geometry_.storage) {
    const SweptRow box = swept(row);
    add(X_lidar_armbase * X_base_armbase_.inverse() * box.X_base_box, box.size_m);
  }

  for (const kiln::Capsule& c : geometry_.armCapsules(q, X_lidar_armbase)) {
    const double radius = c.radius + config_.margin_m;
    const Eigen::Vector3f along = (c.b - c.a).cast<float>();
    const float length2 = along.squaredNorm();
    body.capsules.push_back({c.a.cast<float>(), along, length2 > 1e-8f ? 1.0f / length2 : 0.0f,
                             static_cast<float>(radius * radius)});
    const double far = std::max(c.a.norm(), c.b.norm()) + radius;
    body.reach2 = std::max(body.reach2, static_cast<float>(far * far));
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

std::vector<bool> SelfFilter::ownPoints(const PointCloud& scan, const std::vector<Body>& bodies,
                                        float duration_s) const {
  std::vector<bool> own(scan.size(), false);
  if (bodies.empty()) return own;
  const auto slices = static_cast<float>(bodies.size());
  const float slices_per_s = duration_s > 0 ? slices / duration_s : 0.0f;
  for (std::size_t i = 0; i < scan.size(); ++i) {
    const Eigen::Vector3f p(scan.x[i], scan.y[i], scan.z[i]);
    const float slice = std::clamp(scan.time_offset_s[i] * slices_per_s, 0.0f, slices - 1.0f);
    const Body& body = bodies[static_cast<std::size_t>(slice)];
    own[i] = p.squaredNorm() <= body.reach2 && contains(body, p);
  }
  markEdges(scan, own);
  return own;
}

/// Points of a ring stand in the order of their time; a column is the time between two firings.
void SelfFilter::markEdges(const PointCloud& scan, std::vector<bool>& own) const {
  constexpr std::size_t kRings = 256;
  constexpr float kColumn_s = 55.3e-6f;  // VLP-16 manual: one firing of all lasers
  std::array<std::vector<std::uint32_t>, kRings> rings;
  for (std::size_t i = 0; i < scan.size(); ++i)
    rings[scan.ring[i]].push_back(static_cast<std::uint32_t>(i));
  const auto rangeOf = [&](std::size_t i) {
    return std::sqrt(scan.x[i] * scan.x[i] + scan.y[i] * scan.y[i] + scan.z[i] * scan.z[i]);
  };
  const float reach_s = (static_cast<float>(config_.edge_columns) + 0.5f) * kColumn_s;
  const auto depth = static_cast<float>(config_.mixing_depth_m);
  std::vector<std::uint32_t> mixed;
  for (const auto& ring : rings) {
    for (std::size_t k = 0; k < ring.size(); ++k) {
      if (!own[ring[k]]) continue;
      const float range = rangeOf(ring[k]), t = scan.time_offset_s[ring[k]];
      const auto look = [&](std::size_t other) {
        if (std::abs(scan.time_offset_s[ring[other]] - t) > reach_s) return false;
        if (!own[ring[other]] && rangeOf(ring[other]) - range < depth) mixed.push_back(ring[other]);
        return true;
      };
      for (std::size_t j = k; j-- > 0 && look(j);) {
      }
      for (std::size_t j = k + 1; j < ring.size() && look(j); ++j) {
      }
    }
  }
  for (const std::uint32_t i : mixed) own[i] = true;
}

SelfFilter::Output SelfFilter::filter(const PointCloud& scan, const ArmTrack& arm,
                                      std::span<const BoxConfig> held) const {
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
    bodies.push_back(bodyAt(*arm.at(scan.stamp + fromSeconds(middle)), held));
  }
  const std::vector<bool> own = ownPoints(scan, bodies, duration);
  for (std::size_t i = 0; i < scan.size(); ++i) {
    if (!std::isfinite(scan.x[i] + scan.y[i] + scan.z[i])) {
      ++out.invalid;
    } else if (own[i]) {
      ++out.removed;
    } else {
      out.cloud.push(scan.x[i], scan.y[i], scan.z[i], scan.intensity[i], scan.ring[i],
                     scan.time_offset_s[i]);
    }
  }
  return out;
}

}  // namespace kiln
