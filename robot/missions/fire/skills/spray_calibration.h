#pragma once

#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "common/config/config_archive.h"
#include "common/core/error.h"

namespace kiln {

/// Where the jet goes, as measured: a table over the distance along the line of exit (nozzle X).
/// Measured in the world by `kiln-eval spray-calibration`, kept in
/// resources/config/spray_calibration.yaml. The defaults are ballistic for 6 m/s: drop = g d^2 / (2
/// v^2), 11 cm at 0.9 m (scenario.md section 2).
///
/// For a jet without drag the drop below the line of exit depends on the distance along that line
/// alone, whatever the pitch; so one table serves all aims.
struct SprayCalibration {
  double exit_speed_mps = 6.0;                                                 ///< at full flow
  std::vector<double> distance_m{0.3, 0.5, 0.7, 0.9, 1.1, 1.3};                ///< ascending
  std::vector<double> drop_m{0.0123, 0.0341, 0.0668, 0.1104, 0.1649, 0.2303};  ///< along gravity
  std::vector<double> lateral_m{0, 0, 0, 0, 0, 0};  ///< to the left of the line of exit
  double spread_deg = 2.0;                          ///< rms of the jet's cone
  double empty_tank_fade =
      0.2;  ///< share of the flow, hence speed, that is lost as the tank empties

  void visit(ConfigArchive& a);
  [[nodiscard]] Result<void> validate() const;

  /// @param distance_m  along the line of exit, >= 0. Between entries linear, outside growing with
  /// the square.
  /// @param flow_scale  present flow by full flow, > 0; the drop grows with 1 / flow_scale^2.
  [[nodiscard]] double dropAt(double distance_m, double flow_scale = 1.0) const;
  [[nodiscard]] double lateralAt(double distance_m) const;
  /// Share of the full flow that a tank at `level` (0..1) still gives.
  [[nodiscard]] double flowScale(double level) const;
};

/// Where the jet goes is never a default: every table must stand in the file. Errors: those of
/// loadComplete() and validate().
[[nodiscard]] Result<SprayCalibration> loadSprayCalibration(const std::string& resource);

}  // namespace kiln
