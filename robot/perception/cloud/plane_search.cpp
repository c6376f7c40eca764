#include "robot/perception/cloud/plane_search.h"

#include <algorithm>
#include <cmath>
#include <random>

#include <Eigen/Geometry>

namespace kiln {

std::optional<SupportedPlane> searchPlane(std::span<const Eigen::Vector3d> points,
                                          const PlaneSearch& search) {
  if (points.size() < 3) return std::nullopt;
  const std::size_t stride = std::max<std::size_t>(1, points.size() / search.most_voters);
  std::mt19937 random(search.seed);
  std::uniform_int_distribution<std::size_t> any(0, points.size() - 1);
  std::optional<SupportedPlane> best;
  for (int trial = 0; trial < search.trials; ++trial) {
    const Eigen::Vector3d &a = points[any(random)], &b = points[any(random)],
                          &c = points[any(random)];
    SupportedPlane plane;
    plane.n = (b - a).cross(c - a);
    if (plane.n.norm() < search.least_m2) continue;
    plane.n.normalize();
    if (plane.n.dot(search.towards) < 0.0) plane.n = -plane.n;
    plane.d_m = plane.n.dot(a);
    if (plane.n.dot(search.towards) < std::cos(search.within_rad) ||
        std::abs(plane.n.dot(search.near) - plane.d_m) > search.near_m)
      continue;
    for (std::size_t i = 0; i < points.size(); i += stride)
      plane.votes += std::abs(plane.n.dot(points[i]) - plane.d_m) < search.tolerance_m ? 1 : 0;
    if (!best || plane.votes > best->votes) best = plane;
  }
  return best;
}

}  // namespace kiln
