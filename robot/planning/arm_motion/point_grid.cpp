#include "robot/planning/arm_motion/point_grid.h"

#include <cmath>

#include "common/core/check.h"

namespace kiln {

PointGrid::PointGrid(std::vector<Eigen::Vector3f> points, double cell_m)
    : cell_m_(cell_m), points_(std::move(points)) {
  KILN_CHECK(cell_m > 0.0, cell_m);
  std::erase_if(points_, [](const Eigen::Vector3f& p) { return !p.allFinite(); });
  for (std::size_t i = 0; i < points_.size(); ++i)
    cells_[keyOf(cellOf(points_[i].cast<double>()))].push_back(static_cast<std::uint32_t>(i));
}

PointGrid::Cell PointGrid::cellOf(const Eigen::Vector3d& p) const {
  return (p / cell_m_).array().floor().cwiseMax(-1e6).cwiseMin(1e6).cast<int>();
}

std::uint64_t PointGrid::keyOf(const Cell& cell) {
  const auto bits = [](int v) { return static_cast<std::uint64_t>(v + (1 << 20)); };
  return bits(cell.x()) << 42 | bits(cell.y()) << 21 | bits(cell.z());
}

void PointGrid::visitBox(const Eigen::Vector3d& low, const Eigen::Vector3d& high,
                         const std::function<void(std::size_t)>& visit) const {
  const Cell from = cellOf(low), to = cellOf(high);
  Cell at;
  for (at.x() = from.x(); at.x() <= to.x(); ++at.x()) {
    for (at.y() = from.y(); at.y() <= to.y(); ++at.y()) {
      for (at.z() = from.z(); at.z() <= to.z(); ++at.z()) {
        const auto found = cells_.find(keyOf(at));
        if (found == cells_.end()) continue;
        for (const std::uint32_t i : found->second) visit(i);
      }
    }
  }
}

}  // namespace kiln
