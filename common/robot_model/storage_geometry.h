#pragma once

#include <string>
#include <vector>

#include "common/config/config_archive.h"
#include "common/geom/pose.h"

namespace kiln {

/// A box fixed in a compartment.
struct CompartmentBox {
  std::string name;
  Eigen::Isometry3d X_compartment_box = Eigen::Isometry3d::Identity();
  Eigen::Vector3d size_m = Eigen::Vector3d::Ones();
};

/// A row of bins that travels sideways (paper, "Storage System"): open to the front and the top,
/// its floor inclined backwards, so that what is set in slides against the back.
/// Frame `compartment`: middle of the front edge of the floor, X along the floor to the back (and
/// down, by the incline), Y along the row, which is the way that it travels, Z along the walls.
struct CompartmentConfig {
  std::string name;
  std::vector<double> xyz_m{0, 0, 0};  ///< origin in base at position 0
  double facing_deg = 0.0;             ///< yaw of its open front in base
  double incline_deg = 15.0;           ///< of the floor, backwards
  int bins = 5;
  double bin_width_m = 0.205, bin_depth_m = 0.20;
  double sheet_m = 0.005;  ///< thickness of walls, back and floor
  double wall_height_m = 1.10;
  double travel_min_m = -0.3, travel_max_m = 0.3;  ///< along Y
  double speed_mps = 0.06;
  void visit(ConfigArchive& a);
  /// @param position_m along its travel
  [[nodiscard]] Eigen::Isometry3d X_base_compartment(double position_m) const;
  [[nodiscard]] double pitch() const { return bin_width_m + sheet_m; }
  /// Y of the middle of a bin. @pre bin < bins
  [[nodiscard]] double binY(int bin) const { return (bin - 0.5 * (bins - 1)) * pitch(); }
  /// Floor, back and the walls between and beside the bins.
  [[nodiscard]] std::vector<CompartmentBox> boxes() const;
};

}  // namespace kiln
