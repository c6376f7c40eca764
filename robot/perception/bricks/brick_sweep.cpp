#include "robot/perception/bricks/brick_sweep.h"

#include <algorithm>
#include <cmath>

#include "common/core/check.h"
#include "common/core/units.h"
#include "robot/perception/bricks/surface_leaves.h"

namespace kiln {
namespace {

constexpr double kInstant_s = 0.0016;  // a pose of the LiDAR is looked up so often

bool isFinite(const Eigen::Vector3f& p) { return p.allFinite(); }

/// Does the ray from `o` through `p` and on pass the box?
bool passes(const Eigen::Vector3f& o, const Eigen::Vector3f& p, const Eigen::Vector3f& low,
            const Eigen::Vector3f& high) {
  float enter = 0.0F, leave = 1e9F;
  for (int k = 0; k < 3; ++k) {
    const float d = p[k] - o[k];
    if (std::abs(d) < 1e-9F) {
      if (o[k] < low[k] || o[k] > high[k]) return false;
      continue;
    }
    const float a = (low[k] - o[k]) / d, b = (high[k] - o[k]) / d;
    enter = std::max(enter, std::min(a, b));
    leave = std::min(leave, std::max(a, b));
  }
  return enter <= leave;
}

bool within(const Eigen::Vector3f& p, const Eigen::Vector3f& low, const Eigen::Vector3f& high) {
  return (p.array() >= low.array()).all() && (p.array() <= high.array()).all();
}

Eigen::Isometry3d levelFrame(const GroundFit& ground) {
  Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
  X.linear() = frameFromXAndUp(
      Eigen::Vector3d::UnitX() - ground.n.x() * ground.n,  // in the plane of the ground
      ground.n);
  X.translation() = Eigen::Vector3d(0, 0, ground.d_m / ground.n.z());
  return X;
}

/// @param place  (X_base_lidar at the point's time, point of the scan) to the point in base.
template <class Place>
void append(BrickSweep& sweep, const PointCloud& scan, const PoseTrack& X_base_lidar,
            const Place& place) {
  KILN_CHECK(!X_base_lidar.empty(), "no pose of the LiDAR");
  // Few poses a scan: between two instants the LiDAR moves by less than a tenth of a millimetre.
  std::vector<std::pair<long, Eigen::Isometry3f>> poses;
  const auto poseAt = [&](double t_s) -> const Eigen::Isometry3f& {
    const long instant = std::lround(t_s / kInstant_s);
    if (poses.empty() || poses.back().first != instant)
      poses.emplace_back(
          instant,
          X_base_lidar.at(scan.stamp + fromSeconds(static_cast<double>(instant) * kInstant_s))
              .cast<float>());
    return poses.back().second;
  };
  sweep.points.reserve(sweep.points.size() + scan.size());
  sweep.origins.reserve(sweep.origins.size() + scan.size());
  for (std::size_t i = 0; i < scan.size(); ++i) {
    const Eigen::Vector3f p(scan.x[i], scan.y[i], scan.z[i]);
    if (!isFinite(p)) continue;
    const Eigen::Isometry3f& X = poseAt(static_cast<double>(scan.time_offset_s[i]));
    sweep.points.emplace_back(place(X, p));
    sweep.origins.emplace_back(X.translation());
  }
}

}  // namespace

void SweepPreparation::visit(ConfigArchive& a) {
  a.field("leaf_m", leaf_m, "m", 0.005, 0.1, "thinning");
  a.field("ground_tolerance_m", ground_tolerance_m, "m", 0.005, 0.2, "of the plane");
  a.field("ground_slope_deg", ground_slope_deg, "deg", 0, 30, "of the ground in base, at most");
  a.field("ground_height_m", ground_height_m, "m", 0.02, 2, "of the ground in base, at most");
  a.field("above_ground_m", above_ground_m, "m", 0.01, 0.15, "lower is ground");
  a.field("normal_radius_m", normal_radius_m, "m", 0.02, 0.2, "neighbourhood of a normal");
  a.field("min_ground_points", min_ground_points, "", 10, 100000, "fewer leaves: no ground");
  a.field("min_surface_points", min_surface_points, "", 10, 100000, "fewer leaves: nothing seen");
}

void BrickSweep::add(const PointCloud& scan, const PoseTrack& X_base_lidar) {
  append(*this, scan, X_base_lidar,
         [](const Eigen::Isometry3f& X, const Eigen::Vector3f& p) -> Eigen::Vector3f {
           return X * p;
         });
}

void BrickSweep::addPrepared(const PointCloud& scan_base, const PoseTrack& X_base_lidar) {
  append(*this, scan_base, X_base_lidar,
         [](const Eigen::Isometry3f&, const Eigen::Vector3f& p) { return p; });
}

void BrickSweep::add(const BrickSweep& other) {
  points.insert(points.end(), other.points.begin(), other.points.end());
  origins.insert(origins.end(), other.origins.begin(), other.origins.end());
}

Result<PreparedSweep> prepareSweep(const BrickSweep& sweep, const SweepRegion& region,
                                   const SweepPreparation& config) {
  KILN_CHECK(sweep.points.size() == sweep.origins.size(), sweep.points.size(),
             sweep.origins.size());
  const Eigen::Isometry3f X_region_base = region.X_base_region.inverse().cast<float>();
  const Eigen::Vector3f low = region.low.cast<float>(), high = region.high.cast<float>();
  std::vector<Eigen::Vector3f> inside;
  std::vector<std::size_t> passing;
  for (std::size_t i = 0; i < sweep.size(); ++i) {
    const Eigen::Vector3f p = X_region_base * sweep.points[i];
    const bool in = within(p, low, high);
    if (in) inside.push_back(sweep.points[i]);
    if (in || passes(X_region_base * sweep.origins[i], p, low, high)) passing.push_back(i);
  }
  const std::vector<SurfacePoint> leaves = thin(inside, config.leaf_m);
  const auto ground = fitGround(leaves, config);
  if (!ground) return tl::make_unexpected(ground.error());

  PreparedSweep out;
  out.ground = *ground;
  out.X_base_level = levelFrame(*ground);
  const Eigen::Isometry3f X_level_base = out.X_base_level.inverse().cast<float>();
  Eigen::Vector3f sensor = Eigen::Vector3f::Zero();
  out.beams.reserve(passing.size());
  for (const std::size_t i : passing) {
    out.beams.push_back({X_level_base * sweep.origins[i], X_level_base * sweep.points[i]});
    sensor += (out.beams.back().origin - sensor) / static_cast<float>(out.beams.size());
  }
  out.p_level_sensor = sensor.cast<double>();
  for (const SurfacePoint& leaf : leaves) {
    const Eigen::Vector3f p = X_level_base * leaf.p;
    if (p.z() > static_cast<float>(config.above_ground_m))
      out.surface.push_back({leaf.p, Eigen::Vector3f::Zero(), leaf.count});
  }
  if (static_cast<int>(out.surface.size()) < config.min_surface_points)
    return makeError(ErrorCode::Degenerate,
                     "too few points on bricks: {} leaves of {:.0f} mm above the ground, {} needed",
                     out.surface.size(), 1e3 * config.leaf_m, config.min_surface_points);
  estimateNormals(out.surface, config.leaf_m, config.normal_radius_m,
                  out.X_base_level.cast<float>() * sensor);
  for (SurfacePoint& leaf : out.surface) {
    leaf.p = X_level_base * leaf.p;
    leaf.n = X_level_base.linear() * leaf.n;
  }
  return out;
}

}  // namespace kiln
