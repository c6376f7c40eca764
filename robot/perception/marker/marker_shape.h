#pragma once

#include <array>

#include <Eigen/Core>

#include "robot/scene/wall_layout.h"

namespace kiln::marker {

/// One side of the marker's outline, in the wall frame.
struct Side {
  Eigen::Vector2d from, to;
  Eigen::Vector2d outward;  ///< unit
};

/// The six corners of the L, counter-clockwise, the outer corner first (wall frame of
/// wall_layout.h: X along one leg, Y along the other).
[[nodiscard]] const std::array<Eigen::Vector2d, 6>& corners();
/// The six sides between them; sides 1 and 4 are the ends of the legs along X and Y.
[[nodiscard]] const std::array<Side, 6>& sides();
/// Metres outside of the outline; negative within.
[[nodiscard]] double distanceOutside(const Eigen::Vector2d& p_wall);

/// The marker's middle line cut into cells, from the end of the leg along X over the corner to the
/// end of the leg along Y.
inline constexpr int kCells = 38;
inline constexpr double kCell_m = (2.0 * kMarkerLength_m - kMarkerWidth_m) / kCells;
/// @return -1 outside of the outline.
[[nodiscard]] int cellOf(const Eigen::Vector2d& p_wall);

}  // namespace kiln::marker
