#include "robot/perception/bricks/point_clusters.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Eigenvalues>

#include "common/core/check.h"
#include "robot/perception/bricks/surface_leaves.h"
#include "robot/perception/cloud/leaf_table.h"

namespace kiln {
namespace {

constexpr int kHalfExtent = 1 << 20;

std::uint64_t keyOf(const Eigen::Vector3i& cell) {
  const auto bits = [](int c) {
    return static_cast<std::uint64_t>(std::clamp(c + kHalfExtent, 0, 2 * kHalfExtent - 1));
  };
  return bits(cell.x()) << 42 | bits(cell.y()) << 21 | bits(cell.z());
}

}  // namespace

std::vector<std::vector<std::size_t>> clusterPoints(const std::vector<Eigen::Vector3f>& points,
                                                    double gap_m) {
  KILN_CHECK(gap_m > 0, gap_m);
  LeafTable table(points.size());
  std::vector<Eigen::Vector3i> cells;
  std::vector<std::vector<std::size_t>> members;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3i cell =
        (points[i] / static_cast<float>(gap_m)).array().floor().cast<int>();
    const std::uint32_t at = table.find(keyOf(cell), static_cast<std::uint32_t>(cells.size()));
    if (at == cells.size()) {
      cells.push_back(cell);
      members.emplace_back();
    }
    members[at].push_back(i);
  }
  std::vector<std::vector<std::size_t>> out;
  std::vector<bool> done(cells.size(), false);
  for (std::size_t seed = 0; seed < cells.size(); ++seed) {
    if (done[seed]) continue;
    done[seed] = true;
    std::vector<std::size_t> open{seed};
    out.emplace_back();
    while (!open.empty()) {
      const std::size_t c = open.back();
      open.pop_back();
      out.back().insert(out.back().end(), members[c].begin(), members[c].end());
      for (int k = 0; k < 27; ++k) {
        const Eigen::Vector3i step(k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1);
        const std::uint32_t next = table.get(keyOf(cells[c] + step));
        if (next == LeafTable::kNone || done[next]) continue;
        done[next] = true;
        open.push_back(next);
      }
    }
    std::sort(out.back().begin(), out.back().end());
  }
  return out;
}

GroundOutline outlineOf(const std::vector<Eigen::Vector3f>& points) {
  KILN_CHECK(!points.empty(), points.size());
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  Eigen::Matrix2d squares = Eigen::Matrix2d::Zero();
  GroundOutline out;
  out.low_m = 1e9;
  out.high_m = -1e9;
  for (const Eigen::Vector3f& p : points) {
    const Eigen::Vector2d q = p.head<2>().cast<double>();
    mean += q;
    squares += q * q.transpose();
    out.low_m = std::min(out.low_m, static_cast<double>(p.z()));
    out.high_m = std::max(out.high_m, static_cast<double>(p.z()));
  }
  mean /= static_cast<double>(points.size());
  out.scatter = squares / static_cast<double>(points.size()) - mean * mean.transpose();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> solver(out.scatter);
  Eigen::Vector2d axis = solver.eigenvectors().col(1);
  if (axis.x() < 0.0 || (axis.x() == 0.0 && axis.y() < 0.0)) axis = -axis;
  out.yaw_rad = std::atan2(axis.y(), axis.x());
  const Eigen::Vector2d across(-axis.y(), axis.x());
  Eigen::Vector2d low = Eigen::Vector2d::Constant(1e9), high = -low;
  for (const Eigen::Vector3f& p : points) {
    const Eigen::Vector2d d = p.head<2>().cast<double>() - mean;
    const Eigen::Vector2d q(axis.dot(d), across.dot(d));
    low = low.cwiseMin(q);
    high = high.cwiseMax(q);
  }
  out.length_m = high.x() - low.x();
  out.width_m = high.y() - low.y();
  out.centre = mean + 0.5 * (low.x() + high.x()) * axis + 0.5 * (low.y() + high.y()) * across;
  return out;
}

}  // namespace kiln
