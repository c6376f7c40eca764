#pragma once

#include <vector>

#include "common/config/config_archive.h"
#include "common/model/sensor.h"

namespace kiln {

/// The ground around the robot as one scan shows it, so that heights are told from the local ground
/// and not from z: on a slope, before an edge, with a pitched base. In each sector around the base
/// the profile begins under the wheels (z = 0) and goes out from one piece of visible ground to the
/// next; a piece counts as ground when it is flat, not steeper than a robot could climb, and no
/// bump on what lies behind it. Thread-compatible.
class LocalGround {
 public:
  struct Config {
    int sectors = 48;
    double ring_m = 0.4;  ///< radial length of a cell
    double max_range_m = 14.0;
    double max_slope_deg = 12.0;  ///< steeper is not ground
    double step_m = 0.06;         ///< edges and noise
    double flat_m = 0.10;         ///< a cell that is higher than this holds more than ground
    double bump_m = 0.20;         ///< higher above the line to the ground behind it: a low obstacle
    void visit(ConfigArchive& a);
  };
  /// @param scan_base  prepared scan in `base`; NaN points are skipped. An empty scan yields z = 0.
  LocalGround(const Config& config, const PointCloud& scan_base);
  /// Height of the ground under (x, y) in base, metres.
  [[nodiscard]] double groundAt(double x, double y) const;
  [[nodiscard]] double heightOf(float x, float y, float z) const {
    return z - groundAt(static_cast<double>(x), static_cast<double>(y));
  }

 private:
  struct Node {
    double r_m, z_m;
  };
  [[nodiscard]] std::size_t sectorOf(double x, double y) const;
  [[nodiscard]] std::vector<Node> walk(const std::vector<Node>& cells) const;

  Config config_;
  std::vector<std::vector<Node>> profile_;  ///< by sector, outwards, first node at r = 0
};

}  // namespace kiln
