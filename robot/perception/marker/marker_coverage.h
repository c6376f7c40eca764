#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

namespace kiln::marker {

/// How much of the marker is seen, and how much is seen beside it; shares.
struct Coverage {
  double leg_x = 0.0, leg_y = 0.0, whole = 0.0, outside = 0.0;
  bool end_x = false, end_y = false, corner = false;
  /// Which part is hidden, in words; empty: none. @param min_coverage  of each leg
  [[nodiscard]] std::string hidden(double min_coverage) const;
};

/// @param p_wall    what has the marker's colours, on the ground in the wall frame, metres.
/// @param margin_m  farther off the marker's outline counts as beside it.
[[nodiscard]] Coverage coverageOf(const std::vector<Eigen::Vector2d>& p_wall, double margin_m);

}  // namespace kiln::marker
