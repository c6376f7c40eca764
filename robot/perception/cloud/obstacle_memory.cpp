#include "robot/perception/cloud/obstacle_memory.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "common/core/units.h"
#include "common/geom/bearing.h"

namespace kiln {
namespace {

constexpr std::size_t kRings = 16, kAzimuths = 720;
constexpr double kRingStep = 2.0, kLowestRing = -15.0;  // deg (VLP-16 manual)
constexpr std::int64_t kHalfExtent = 1 << 20;

std::size_t azimuthBin(const Eigen::Vector3f& p_lidar) {
  const double share = (bearing(p_lidar.y(), p_lidar.x()) + M_PI) / (2.0 * M_PI);
  return std::min(static_cast<std::size_t>(std::max(0.0, share * kAzimuths)), kAzimuths - 1);
}

}  // namespace

void ObstacleMemory::Config::visit(ConfigArchive& a) {
  a.field("voxel_m", voxel_m, "m", 0.02, 0.5, "edge of a cube");
  a.field("max_range_m", max_range_m, "m", 1, 30, "from the base");
  a.field("min_height_m", min_height_m, "m", 0.02, 1, "lower is driven over or noise");
  a.field("max_height_m", max_height_m, "m", 0.5, 5, "higher passes over the robot");
  a.field("keep_s", keep_s, "s", 0.5, 600, "not seen for so long: forgotten");
  a.field("min_scans", min_scans, "", 1, 10, "needed to believe");
  a.field("max_misses", max_misses, "", 1, 50, "beams that pass through until it is forgotten");
  a.field("see_through_m", see_through_m, "m", 0.05, 2, "a beam must end so far behind");
  a.field("max_voxels", max_voxels, "", 100, 1000000, "then everything is forgotten");
  a.section("ground", ground, "what is ground");
}

ObstacleScan ObstacleMemory::observe(const Config& config, const PointCloud& scan_base,
                                     const Eigen::Isometry3d& X_base_lidar) {
  ObstacleScan out;
  out.stamp = scan_base.stamp;
  out.X_base_lidar = X_base_lidar;
  out.range_m.assign(kRings * kAzimuths, 0.0f);
  const LocalGround ground(config.ground, scan_base);
  const Eigen::Isometry3f X_lidar_base = X_base_lidar.inverse().cast<float>();
  // Neighbours in a ring that fall into one cube say it once.
  const auto thin = static_cast<float>(0.5 * config.voxel_m);
  std::array<Eigen::Vector3f, kRings> kept;
  kept.fill(Eigen::Vector3f::Constant(INFINITY));
  for (std::size_t i = 0; i < scan_base.size(); ++i) {
    const Eigen::Vector3f p(scan_base.x[i], scan_base.y[i], scan_base.z[i]);
    if (!p.allFinite()) continue;
    const Eigen::Vector3f p_lidar = X_lidar_base * p;
    const std::size_t ring = std::min<std::size_t>(scan_base.ring[i], kRings - 1);
    float& longest = out.range_m[ring * kAzimuths + azimuthBin(p_lidar)];
    longest = std::max(longest, p_lidar.norm());
    if (p.head<2>().squaredNorm() > config.max_range_m * config.max_range_m) continue;
    if ((p - kept[ring]).squaredNorm() < thin * thin) continue;
    const auto height = static_cast<float>(ground.heightOf(p.x(), p.y(), p.z()));
    if (height < config.min_height_m || height > config.max_height_m) continue;
    kept[ring] = p;
    out.points.push_back({p, height});
  }
  return out;
}

std::uint64_t ObstacleMemory::keyOf(const Eigen::Vector3f& p) const {
  const auto cell = [this](float v) {
    return static_cast<std::uint64_t>(static_cast<std::int64_t>(std::floor(v / config_.voxel_m)) +
                                      kHalfExtent);
  };
  return cell(p.x()) << 42 | cell(p.y()) << 21 | cell(p.z());
}

void ObstacleMemory::insert(const ObstacleScan& scan, const Pose2& X_odom_base) {
  const Eigen::Isometry3f X = toIsometry(X_odom_base).cast<float>();
  for (const ObstacleScan::Point& point : scan.points) {
    const Eigen::Vector3f p = X * point.p_base;
    const std::uint64_t key = keyOf(p);
    const auto [slot, fresh] = slots_.try_emplace(key, voxels_.size());
    if (fresh) voxels_.push_back({key});
    Voxel& voxel = voxels_[slot->second];
    if (voxel.scans == 0 || voxel.seen != scan.stamp) ++voxel.scans;
    voxel.p_odom = p;
    voxel.height_m = point.height_m;
    voxel.seen = scan.stamp;
    voxel.misses = 0;
  }
}

void ObstacleMemory::forget(const ObstacleScan& scan, const Pose2& X_odom_base) {
  const Eigen::Isometry3f X_lidar_odom =
      (toIsometry(X_odom_base) * scan.X_base_lidar).inverse().cast<float>();
  const Eigen::Vector3f p_odom_base = toIsometry(X_odom_base).translation().cast<float>();
  const double far2 = std::pow(1.5 * config_.max_range_m, 2);
  const Duration keep = fromSeconds(config_.keep_s);
  const auto gone = [&](Voxel& voxel) {
    if (voxel.seen == scan.stamp) return false;
    if (scan.stamp - voxel.seen > keep) return true;
    if ((voxel.p_odom - p_odom_base).head<2>().squaredNorm() > far2) return true;
    const Eigen::Vector3f p = X_lidar_odom * voxel.p_odom;
    const float range = p.norm();
    const double elevation = std::asin(std::clamp(p.z() / range, -1.0f, 1.0f)) / kDeg;
    const double ring = (elevation - kLowestRing) / kRingStep;
    const double nearest = std::round(ring);
    // Only a beam that goes through the cube itself says something.
    const double half_cube = 0.5 * config_.voxel_m / std::max(0.1f, range) / kDeg / kRingStep;
    if (nearest < 0 || nearest >= static_cast<double>(kRings) ||
        std::abs(ring - nearest) > half_cube)
      return false;
    const float through =
        scan.range_m[static_cast<std::size_t>(nearest) * kAzimuths + azimuthBin(p)];
    if (through < range + config_.see_through_m) return false;
    return ++voxel.misses >= config_.max_misses;
  };
  for (std::size_t i = 0; i < voxels_.size();) {
    if (!gone(voxels_[i])) {
      ++i;
      continue;
    }
    slots_.erase(voxels_[i].key);
    if (i + 1 < voxels_.size()) {
      voxels_[i] = voxels_.back();
      slots_[voxels_[i].key] = i;
    }
    voxels_.pop_back();
  }
  if (voxels_.size() > static_cast<std::size_t>(config_.max_voxels)) {
    voxels_.clear();
    slots_.clear();
  }
}

void ObstacleMemory::publish(Stamp stamp) {
  auto out = std::make_shared<ObstacleCloud>();
  out->stamp = stamp;
  out->points.reserve(voxels_.size());
  for (const Voxel& voxel : voxels_)
    if (voxel.scans >= config_.min_scans) out->points.push_back({voxel.p_odom, voxel.height_m});
  snapshot_ = std::move(out);
}

void ObstacleMemory::add(const ObstacleScan& scan, const Pose2& X_odom_base) {
  if (!std::isfinite(X_odom_base.x_m + X_odom_base.y_m + X_odom_base.yaw_rad)) return;
  insert(scan, X_odom_base);
  forget(scan, X_odom_base);
  publish(scan.stamp);
}

void ObstacleMemory::clear() {
  voxels_.clear();
  slots_.clear();
  snapshot_.reset();
}

}  // namespace kiln
