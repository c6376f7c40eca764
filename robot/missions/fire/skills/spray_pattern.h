#pragma once

#include <vector>

#include "common/config/config_archive.h"
#include "common/geom/pose.h"

namespace kiln {

struct SprayPatternConfig {
  double half_width_deg = 2.0;  ///< tilt to either side; 2.5 cm in the opening at 0.7 m
  double half_height_deg = 1.5;
  int points_per_edge = 4;
  void visit(ConfigArchive& a);
};

/// The paper's hourglass (section "Challenge 3"): the nozzle stays where it is and tilts along top
/// edge, diagonal, bottom edge, diagonal. One closed round, starting and ending at the top left.
/// @param X_map_nozzle  the steady aim, around which the pattern lies.
[[nodiscard]] std::vector<Eigen::Isometry3d> hourglass(const Eigen::Isometry3d& X_map_nozzle,
                                                       const SprayPatternConfig& config);

}  // namespace kiln
