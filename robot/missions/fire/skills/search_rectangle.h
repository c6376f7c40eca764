#pragma once

#include <vector>

#include "common/config/config_archive.h"
#include "common/geom/pose.h"

namespace kiln {

struct SearchConfig {
  double standoff_m = 1.0;  ///< camera to the expected plate
  double standoff_step_m =
      0.1;  ///< when a pose cannot be reached: nearer and farther by this, twice
  double half_width_m = 0.25;
  double half_height_m = 0.12;
  double smallest_scale = 0.4;  ///< the rectangle is shrunk at most to this
  void visit(ConfigArchive& a);
};

/// Pose of a camera (X right, Y down, Z viewing) at p that looks at a target, upright. @pre not
/// straight up or down.
[[nodiscard]] Eigen::Isometry3d lookAt(const Eigen::Vector3d& p, const Eigen::Vector3d& p_target);

/// The paper's rectangular search motion: corners around the place's axis, each looking at the
/// place, then its middle. Top left first, clockwise as the camera sees it. X_map_thermal, 6 poses.
[[nodiscard]] std::vector<Eigen::Isometry3d> searchRectangle(const Eigen::Vector3d& p_place_map,
                                                             const Eigen::Vector3d& normal_map,
                                                             double standoff_m, double half_width_m,
                                                             double half_height_m);

}  // namespace kiln
