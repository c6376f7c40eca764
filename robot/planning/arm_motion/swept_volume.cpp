#include "robot/planning/arm_motion/swept_volume.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace kiln {
namespace {

/// Points near arm or head, with the part each is near to.
struct Near {
  std::size_t point;
  std::string part;
};

double toBox(const Eigen::Vector3d& p, const OrientedBox& box) {
  return signedDistance(box.X_frame_box.inverse() * p, box.half);
}

double toCapsule(const Eigen::Vector3d& p, const Capsule& c) {
  const Eigen::Vector3d along = c.b - c.a;
  const double length2 = along.squaredNorm();
  const double s = length2 > 0.0 ? std::clamp((p - c.a).dot(along) / length2, 0.0, 1.0) : 0.0;
  return (p - c.a - s * along).norm() - c.radius;
}

std::vector<Near> nearArm(const ArmCollision& arm, const Vector6d& q, const PointGrid& points,
                          double clearance_m) {
  std::vector<Near> out;
  const ArmShapes shapes = arm.shapesAt(q);
  const Eigen::Vector3d grown = Eigen::Vector3d::Constant(clearance_m);
  for (std::size_t link = 0; link < shapes.links.size(); ++link) {
    if (arm.standsStill(link)) continue;  // what is there was there before
    const Capsule& c = shapes.links[link];
    const Eigen::AlignedBox3d bounds = boundsOf(c);
    points.visitBox(bounds.min() - grown, bounds.max() + grown, [&](std::size_t i) {
      if (toCapsule(points[i].cast<double>(), c) < clearance_m)
        out.push_back({i, arm.nameOf(link)});
    });
  }
  for (const OrientedBox& part : shapes.head) {
    points.visitBox(part.bounds.min() - grown, part.bounds.max() + grown, [&](std::size_t i) {
      if (toBox(points[i].cast<double>(), part) < clearance_m) out.push_back({i, part.name});
    });
  }
  return out;
}

/// Enough of them in one place?
std::optional<SweptHit> judged(const std::vector<Near>& found, const PointGrid& points,
                               const SweptVolumeConfig& config) {
  if (found.size() < static_cast<std::size_t>(config.min_points)) return std::nullopt;
  std::vector<bool> counted(points.size(), false);
  for (const Near& seed : found) {
    SweptHit hit;
    std::fill(counted.begin(), counted.end(), false);
    for (const Near& other : found) {
      const Eigen::Vector3d p = points[other.point].cast<double>();
      if (counted[other.point] || (p - points[seed.point].cast<double>()).norm() > config.gather_m)
        continue;
      counted[other.point] = true;
      hit.p_base += p;
      ++hit.points;
    }
    if (hit.points < config.min_points) continue;
    hit.p_base /= hit.points;
    hit.part = seed.part;
    return hit;
  }
  return std::nullopt;
}

}  // namespace

void SweptVolumeConfig::visit(ConfigArchive& a) {
  a.field("clearance_m", clearance_m, "m", 0, 0.3, "a nearer point is in the way");
  a.field("min_points", min_points, "", 1, 100, "fewer are noise");
  a.field("gather_m", gather_m, "m", 0.01, 1, "points in the way count together within this");
  a.field("step_m", step_m, "m", 0.005, 0.2, "between two postures that are looked at");
}

std::optional<SweptHit> firstInSweptVolume(const ArmCollision& arm,
                                           std::span<const JointPath> paths,
                                           const PointGrid& points,
                                           const SweptVolumeConfig& config) {
  if (paths.empty() || points.size() == 0) return std::nullopt;
  std::vector<bool> own(points.size(), false);
  const auto begin = nearArm(arm, paths.front().q.front(), points, config.clearance_m);
  for (const Near& near : begin) own[near.point] = true;
  double length = 0.0, covered = 0.0;
  for (const JointPath& path : paths)
    for (std::size_t k = 1; k < path.q.size(); ++k)
      length += arm.motionBound(path.q[k] - path.q[k - 1]);
  for (const JointPath& path : paths) {
    double since = config.step_m;  // the first posture of each path is looked at
    for (std::size_t k = 0; k < path.q.size(); ++k) {
      const Vector6d dq = k == 0 ? Vector6d(Vector6d::Zero()) : Vector6d(path.q[k] - path.q[k - 1]);
      const double way = arm.motionBound(dq);
      const int cuts = std::max(1, static_cast<int>(std::ceil(way / config.step_m)));
      for (int cut = 1; cut <= cuts; ++cut) {
        since += way / cuts;
        covered += way / cuts;
        const bool last = k + 1 == path.q.size() && cut == cuts;
        if (since < config.step_m && !last) continue;
        since = 0.0;
        const Vector6d q = path.q[k] - dq * (1.0 - static_cast<double>(cut) / cuts);
        auto found = nearArm(arm, q, points, config.clearance_m);
        std::erase_if(found, [&](const Near& near) { return own[near.point]; });
        if (auto hit = judged(found, points, config)) {
          hit->path_share = length > 0.0 ? std::min(1.0, covered / length) : 1.0;
          return hit;
        }
      }
    }
  }
  return std::nullopt;
}

}  // namespace kiln
