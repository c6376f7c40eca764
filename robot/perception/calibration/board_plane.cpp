#include "robot/perception/calibration/board_plane.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <Eigen/Eigenvalues>

#include "common/core/units.h"
#include "robot/perception/cloud/plane_search.h"

namespace kiln {
namespace {

constexpr double kThick_m = 0.03;  // two to three sigma of the LiDAR
constexpr int kTries = 400;
constexpr std::size_t kLeastPoints = 200;
constexpr double kLeastShare =
    0.25;  // of all points near the place: a cut through a crowd has less

std::vector<Eigen::Vector3d> pointsNear(std::span<const StillScan> scans,
                                        const LidarCalibration& lidar, const BoardPrior& prior) {
  const double reach = prior.within_m + std::hypot(prior.half_width_m, prior.half_height_m);
  const double top = prior.where.p.z() + prior.half_height_m,
               bottom = prior.where.p.z() - prior.half_height_m;
  std::vector<Eigen::Vector3d> out;
  for (const StillScan& still : scans) {
    const Eigen::Isometry3d X = still.X_base_flange * lidar.flange_lidar.X_parent_sensor;
    const PointCloud& cloud = *still.scan_lidar;
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      const Eigen::Vector3d p(cloud.x[i], cloud.y[i], cloud.z[i]);
      const double range = p.norm();
      if (!(range > 0.1) || cloud.ring[i] >= lidar.range_bias_m.size()) continue;
      const Eigen::Vector3d at = X * ((range - lidar.range_bias_m[cloud.ring[i]]) / range * p);
      // A few centimetres of its rim are left out: mixed with what stands behind.
      if ((at - prior.where.p).norm() < reach && at.z() > bottom + 0.05 && at.z() < top - 0.05)
        out.push_back(at);
    }
  }
  return out;
}

BoardPlane fit(const std::vector<Eigen::Vector3d>& points, const Eigen::Vector3d& towards) {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& p : points) mean += p;
  mean /= static_cast<double>(points.size());
  Eigen::Matrix3d C = Eigen::Matrix3d::Zero();
  for (const Eigen::Vector3d& p : points) C += (p - mean) * (p - mean).transpose();
  C /= static_cast<double>(points.size());
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solved(C);
  Eigen::Vector3d normal = solved.eigenvectors().col(0);
  if (normal.dot(towards) < 0.0) normal = -normal;
  return {mean, normal, std::sqrt(std::max(0.0, solved.eigenvalues()[0])),
          static_cast<int>(points.size())};
}

std::vector<Eigen::Vector3d> on(const BoardPlane& plane,
                                const std::vector<Eigen::Vector3d>& points) {
  std::vector<Eigen::Vector3d> out;
  std::copy_if(points.begin(), points.end(), std::back_inserter(out),
               [&](const auto& p) { return std::abs(plane.normal.dot(p - plane.p)) < kThick_m; });
  return out;
}

/// Middle between the ends seen, ends being where one in fifty points lies beyond.
Eigen::Vector3d middle(const BoardPlane& plane, const std::vector<Eigen::Vector3d>& points,
                       double height) {
  const Eigen::Vector3d along = Eigen::Vector3d::UnitZ().cross(plane.normal).normalized();
  std::vector<double> places;
  for (const Eigen::Vector3d& p : points) places.push_back(along.dot(p - plane.p));
  std::sort(places.begin(), places.end());
  const double from = places[places.size() / 50],
               to = places[places.size() - 1 - places.size() / 50];
  Eigen::Vector3d out = plane.p + 0.5 * (from + to) * along;
  out.z() = height;
  // Back onto the plane, which may lean a little.
  return out - plane.normal.dot(out - plane.p) * plane.normal;
}

}  // namespace

Result<BoardPlane> findBoard(std::span<const StillScan> scans, const LidarCalibration& lidar,
                             const BoardPrior& prior) {
  const auto points = pointsNear(scans, lidar, prior);
  const auto missing = [&] {
    return makeError(ErrorCode::NotFound,
                     "no board where the yard's map has one, {:.1f} m from the base: put the robot "
                     "and the board where they belong",
                     prior.where.p.head<2>().norm());
  };
  if (points.size() < kLeastPoints) return missing();
  PlaneSearch search;
  search.towards = prior.where.normal;
  search.within_rad = prior.within_deg * kDeg;
  search.near = prior.where.p;
  search.near_m = prior.within_m;
  search.tolerance_m = kThick_m;
  search.least_m2 = 0.01;
  search.trials = kTries;
  search.seed = 7;
  const auto found = searchPlane(points, search);
  if (!found) return missing();
  std::vector<Eigen::Vector3d> best = on({found->d_m * found->n, found->n, 0.0, 0}, points);
  const auto share = static_cast<std::size_t>(kLeastShare * static_cast<double>(points.size()));
  if (best.size() < std::max(kLeastPoints, share)) return missing();
  BoardPlane out = fit(best, prior.where.normal);
  for (int round = 0; round < 3; ++round) {
    best = on(out, points);
    if (best.size() < kLeastPoints) return missing();
    out = fit(best, prior.where.normal);
  }
  out.p = middle(out, best, prior.where.p.z());
  return out;
}

}  // namespace kiln
