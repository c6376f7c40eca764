#include "robot/perception/marker/ground_plane.h"

#include <cmath>
#include <limits>
#include <vector>

#include <Eigen/Dense>

#include "common/core/units.h"
#include "robot/perception/cloud/plane_search.h"

namespace kiln {
namespace {

constexpr double kLeast_m2 = 0.2;  // smaller triangles say nothing about a tilt

using Rows = std::vector<Eigen::Vector3d>;

Rows around(const PointCloud& scan, const Eigen::Vector2d& p, double radius_m) {
  Rows out;
  for (std::size_t i = 0; i < scan.size(); ++i) {
    const Eigen::Vector3d point = Eigen::Vector3f(scan.x[i], scan.y[i], scan.z[i]).cast<double>();
    if (point.allFinite() && (point.head<2>() - p).norm() <= radius_m) out.push_back(point);
  }
  return out;
}

double offPlane(const Eigen::Vector3d& p, const Eigen::Vector3d& plane) {
  return std::abs(p.z() - plane.dot(Eigen::Vector3d(1.0, p.x(), p.y())));
}

}  // namespace

void GroundPlaneConfig::visit(ConfigArchive& a) {
  a.field("radius_m", radius_m, "m", 0.3, 20, "around the place that is asked for");
  a.field("tolerance_m", tolerance_m, "m", 0.005, 0.5, "of a point of the ground");
  a.field("max_slope_deg", max_slope_deg, "deg", 1, 45, "steeper is not ground");
  a.field("min_points", min_points, "", 3, 100000, "fewer say nothing");
  a.field("min_share", min_share, "", 0.05, 1, "of the points in the circle");
  a.field("lidar_sigma_deg", lidar_sigma_deg, "deg", 0, 5, "mounting of the LiDAR, each axis");
  a.field("lidar_sigma_m", lidar_sigma_m, "m", 0, 0.1, "mounting of the LiDAR, each axis");
  a.field("noise_m", noise_m, "m", 0.001, 0.2, "height of a point, one sigma");
}

Eigen::Vector3d GroundPlane::normal() const {
  return Eigen::Vector3d(-coefficients[1], -coefficients[2], 1.0).normalized();
}

Eigen::Vector3d GroundPlane::meet(const Eigen::Vector3d& origin,
                                  const Eigen::Vector3d& direction) const {
  const double above = origin.z() - height(origin.x(), origin.y());
  const double sinking = -(direction.z() - coefficients.tail<2>().dot(direction.head<2>()));
  const double range = above / sinking;
  if (!(range > 0.0) || !std::isfinite(range))
    return Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
  return origin + range * direction;
}

Result<GroundPlane> fitGroundPlane(const PointCloud& scan_base, const Eigen::Vector2d& p_base,
                                   const GroundPlaneConfig& config) {
  const Rows points = around(scan_base, p_base, config.radius_m);
  if (static_cast<int>(points.size()) < config.min_points)
    return makeError(ErrorCode::Degenerate,
                     "ground at ({:.1f}, {:.1f}) m: {} LiDAR points within {:.1f} m, {} are needed",
                     p_base.x(), p_base.y(), points.size(), config.radius_m, config.min_points);
  PlaneSearch search;
  search.within_rad = config.max_slope_deg * kDeg;
  search.tolerance_m = config.tolerance_m;
  search.least_m2 = kLeast_m2;
  const SupportedPlane plane = searchPlane(points, search).value_or(SupportedPlane{});
  if (static_cast<double>(plane.votes) < config.min_share * static_cast<double>(points.size()))
    return makeError(ErrorCode::Degenerate,
                     "ground at ({:.1f}, {:.1f}) m: {} of {} LiDAR points lie on one plane, {:.0f} "
                     "% are needed",
                     p_base.x(), p_base.y(), plane.votes, points.size(), 100.0 * config.min_share);
  Eigen::Vector3d best(plane.d_m, -plane.n.x(), -plane.n.y());
  best /= plane.n.z();
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  for (int round = 0; round < 2; ++round) {
    information.setZero();
    Eigen::Vector3d right = Eigen::Vector3d::Zero();
    for (const Eigen::Vector3d& p : points) {
      if (offPlane(p, best) > config.tolerance_m) continue;
      const Eigen::Vector3d row(1.0, p.x(), p.y());
      information += row * row.transpose();
      right += row * p.z();
    }
    best = information.ldlt().solve(right);
  }
  GroundPlane out;
  out.coefficients = best;
  const double tilt = config.lidar_sigma_deg * kDeg, shift = config.lidar_sigma_m;
  out.covariance = config.noise_m * config.noise_m * information.inverse();
  out.covariance.diagonal() += Eigen::Vector3d(shift * shift, tilt * tilt, tilt * tilt);
  if (!out.covariance.allFinite() || !best.allFinite())
    return makeError(ErrorCode::Degenerate, "ground at ({:.1f}, {:.1f}) m: points on one line only",
                     p_base.x(), p_base.y());
  return out;
}

Result<GroundPlane> groundAlongRay(const PointCloud& scan_base, const Eigen::Vector3d& origin,
                                   const Eigen::Vector3d& direction, double max_range_m,
                                   const GroundPlaneConfig& config) {
  constexpr int kLooks = 3;
  GroundPlane plane = GroundPlane::flat();
  for (int look = 0; look < kLooks; ++look) {
    Eigen::Vector3d p = plane.meet(origin, direction);
    if (!p.allFinite() || !(p.head<2>().norm() <= max_range_m)) {
      if (look > 0)
        return makeError(ErrorCode::NotFound, "no ground within {:.0f} m along this ray",
                         max_range_m);
      // Up a slope the first guess may lie beyond; begin at the farthest place.
      p.head<2>() = origin.head<2>() + 0.6 * max_range_m * direction.head<2>().normalized();
    }
    auto found = fitGroundPlane(scan_base, p.head<2>(), config);
    if (!found) return found;
    plane = *found;
  }
  return plane;
}

}  // namespace kiln
