#pragma once

#include <cstdint>
#include <functional>
#include <unordered_map>
#include <vector>

#include <Eigen/Core>

namespace kiln {

/// Points in cells, so that those near a shape are found without looking at all. Metres, one frame.
/// Thread-compatible; const calls are thread-safe.
class PointGrid {
 public:
  /// NaN points are left out. @pre cell_m > 0.
  explicit PointGrid(std::vector<Eigen::Vector3f> points, double cell_m = 0.15);
  [[nodiscard]] std::size_t size() const { return points_.size(); }
  [[nodiscard]] const Eigen::Vector3f& operator[](std::size_t i) const { return points_[i]; }
  /// Calls `visit(index)` for each point in the axis-aligned box, and perhaps some beside it.
  void visitBox(const Eigen::Vector3d& low, const Eigen::Vector3d& high,
                const std::function<void(std::size_t)>& visit) const;

 private:
  using Cell = Eigen::Vector3i;
  [[nodiscard]] Cell cellOf(const Eigen::Vector3d& p) const;
  [[nodiscard]] static std::uint64_t keyOf(const Cell& cell);

  double cell_m_;
  std::vector<Eigen::Vector3f> points_;
  std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> cells_;
};

}  // namespace kiln
