#include "robot/perception/marker/marker_shape.h"

#include <algorithm>
#include <cmath>

namespace kiln::marker {

namespace {

constexpr double kL = kMarkerLength_m, kW = kMarkerWidth_m;

/// Metres outside of a box from the origin to (x, y); negative within.
double outsideOfBox(const Eigen::Vector2d& p, double x, double y) {
  const double dx = std::max(-p.x(), p.x() - x), dy = std::max(-p.y(), p.y() - y);
  return dx > 0.0 && dy > 0.0 ? std::hypot(dx, dy) : std::max(dx, dy);
}

}  // namespace

const std::array<Eigen::Vector2d, 6>& corners() {
  static const std::array<Eigen::Vector2d, 6> all{
      {{0.0, 0.0}, {kL, 0.0}, {kL, kW}, {kW, kW}, {kW, kL}, {0.0, kL}}};
  return all;
}

const std::array<Side, 6>& sides() {
  static const std::array<Side, 6> all = [] {
    std::array<Side, 6> out;
    for (std::size_t i = 0; i < 6; ++i) {
      const Eigen::Vector2d a = corners()[i], b = corners()[(i + 1) % 6];
      const Eigen::Vector2d along = (b - a).normalized();
      out[i] = {a, b, {along.y(), -along.x()}};
    }
    return out;
  }();
  return all;
}

double distanceOutside(const Eigen::Vector2d& p) {
  return std::min(outsideOfBox(p, kL, kW), outsideOfBox(p, kW, kL));
}

int cellOf(const Eigen::Vector2d& p) {
  if (!(distanceOutside(p) <= 0.0)) return -1;
  // Along the middle line: the corner's square counts to the leg in which the point lies deeper.
  const double along = p.x() >= p.y() ? kL - p.x() : kL - kW + p.y();
  return std::clamp(static_cast<int>(along / kCell_m), 0, kCells - 1);
}

}  // namespace kiln::marker
