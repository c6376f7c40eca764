#pragma once

#include <array>
#include <vector>

#include <Eigen/Geometry>

namespace kiln::sim {

/// Where drops pass at fixed distances along the line of exit: what a spray calibration measures
/// with a ruled board.
class JetProfile {
 public:
  static constexpr std::array<double, 11> kDistances_m{0.3, 0.4, 0.5, 0.6, 0.7, 0.8,
                                                       0.9, 1.0, 1.1, 1.2, 1.3};
  struct Row {
    double distance_m = 0.0;
    double drops = 0.0;
    double drop_m = 0.0;     ///< mean fall below the line of exit, along gravity
    double lateral_m = 0.0;  ///< mean, to the left of the line of exit
    double rms_m = 0.0;      ///< about the mean, both directions together
  };
  /// One drop's way from a to b (map) after it left a nozzle at X_map_nozzle (X along the jet).
  void pass(const Eigen::Isometry3d& X_map_nozzle, const Eigen::Vector3d& a,
            const Eigen::Vector3d& b);
  [[nodiscard]] std::vector<Row> rows() const;

 private:
  struct Sum {
    double n = 0.0, fall = 0.0, lateral = 0.0, square = 0.0;
  };
  std::array<Sum, kDistances_m.size()> sums_{};
};

}  // namespace kiln::sim
