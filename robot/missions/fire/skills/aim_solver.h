#pragma once

#include <functional>
#include <vector>

#include "common/geom/pose.h"
#include "robot/missions/fire/skills/spray_calibration.h"

namespace kiln {

/// What to hit: the middle of the opening, from which the jet goes on to the recessed plate.
struct AimTarget {
  Eigen::Vector3d p_plate_map = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal_map =
      Eigen::Vector3d::UnitX();  ///< unit, horizontal, from the plate through the opening
  double recess_m = 0.10;
  [[nodiscard]] Eigen::Vector3d p_opening_map() const {
    return p_plate_map + recess_m * normal_map;
  }
};

/// One way to stand before the target.
struct AimVariation {
  double standoff_m = 0.8;   ///< nozzle to plate along the normal
  double lateral_rad = 0.0;  ///< nozzle aside, about the opening's vertical axis
  double height_factor =
      1.0;  ///< 1: nozzle so low that the jet is level in the opening; 0: at the opening's height
};

/// Nozzle pose in `map` from which the calibrated jet passes through the middle of the opening.
[[nodiscard]] Eigen::Isometry3d aimNozzle(const AimTarget& target, const AimVariation& variation,
                                          const SprayCalibration& calibration, double flow_scale);

struct AimSolverConfig {
  double standoff_m = 0.80;  ///< preferred
  double min_standoff_m = 0.65;
  double max_standoff_m = 0.95;
  double standoff_step_m = 0.05;
  double max_lateral_deg = 20.0;  ///< steeper jets clip the opening's edge
  double lateral_step_deg = 10.0;
  void visit(ConfigArchive& a);
};

struct AimSolution {
  AimVariation variation;
  Eigen::Isometry3d X_map_nozzle = Eigen::Isometry3d::Identity();
};

/// The variations in the order of preference: small departures from the preferred standoff and the
/// normal first.
[[nodiscard]] std::vector<AimVariation> aimVariations(const AimSolverConfig& config);

/// The first variation that `feasible` accepts (reach and collision, judged by MoveArm::check).
/// Error{Refused}: none is; tells the reason of the preferred one.
[[nodiscard]] Result<AimSolution> solveAim(
    const AimTarget& target, const AimSolverConfig& config, const SprayCalibration& calibration,
    double flow_scale, const std::function<Result<void>(const Eigen::Isometry3d&)>& feasible);

}  // namespace kiln
