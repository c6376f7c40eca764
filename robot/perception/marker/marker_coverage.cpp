#include "robot/perception/marker/marker_coverage.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "robot/perception/marker/marker_shape.h"

namespace kiln::marker {

Coverage coverageOf(const std::vector<Eigen::Vector2d>& p_wall, double margin_m) {
  std::array<int, kCells> hits{};
  std::size_t outside = 0;
  for (const Eigen::Vector2d& p : p_wall) {
    const int cell = cellOf(p);
    if (cell >= 0) ++hits[static_cast<std::size_t>(cell)];
    if (distanceOutside(p) > margin_m) ++outside;
  }
  const auto filled = [&](int from, int to) {
    int n = 0;
    for (int i = from; i < to; ++i) n += hits[static_cast<std::size_t>(i)] >= 2 ? 1 : 0;
    return n;
  };
  constexpr int kCorner = kCells / 2;  // the middle cells
  Coverage out;
  out.leg_x = filled(0, kCorner) / static_cast<double>(kCorner);
  out.leg_y = filled(kCorner, kCells) / static_cast<double>(kCells - kCorner);
  out.whole = filled(0, kCells) / static_cast<double>(kCells);
  out.end_x = filled(0, 2) > 0;
  out.end_y = filled(kCells - 2, kCells) > 0;
  out.corner = filled(kCorner - 1, kCorner + 1) > 0;
  out.outside =
      static_cast<double>(outside) / static_cast<double>(std::max<std::size_t>(1, p_wall.size()));
  return out;
}

std::string Coverage::hidden(double min_coverage) const {
  if (!corner) return "half hidden: the corner of the L is not seen";
  if (!end_x || !end_y)
    return fmt::format("half hidden: the end of the leg along {} is not seen", end_x ? "Y" : "X");
  if (std::min(leg_x, leg_y) >= min_coverage) return {};
  return fmt::format("half hidden: {:.0f} % and {:.0f} % of the legs are seen, {:.0f} % are needed",
                     100.0 * leg_x, 100.0 * leg_y, 100.0 * min_coverage);
}

}  // namespace kiln::marker
