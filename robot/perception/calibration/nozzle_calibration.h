#pragma once

#include <functional>
#include <span>

#include "common/config/config_archive.h"
#include "robot/perception/calibration/board_plane.h"
#include "robot/perception/calibration/extrinsics.h"

namespace kiln {

/// Where the jet landed on the board, seen by the thermal camera while arm and base stood still.
struct LandedJet {
  Eigen::Isometry3d X_base_flange = Eigen::Isometry3d::Identity();  ///< by the joints
  Eigen::Vector2d centre_px = Eigen::Vector2d::Zero();              ///< findWetSpot()
  double flow_scale = 1.0;  ///< present flow by full flow, as the tanks' estimate has it
};

/// Centre of the jet in base, at a distance along the line of exit: what aiming believes of it.
using JetPath = std::function<Eigen::Vector3d(const Eigen::Isometry3d& X_base_nozzle,
                                              double distance_m, double flow_scale)>;

struct NozzleCalibration {
  Extrinsics flange_nozzle;
  double flow = 1.0;  ///< of this robot's pumps together, by the nominal flow
  double flow_sigma = 0.0;
};

/// Mounting pose of the nozzle: water is sprayed on a warm board from several arm postures, and the
/// calibrated thermal camera sees where it lands. Differing distances tell the direction of the jet
/// from its place; a head that is rolled between the postures tells a tilt of the nozzle, which
/// rolls with it, from the jet's fall, which does not. Unknown beside it: the pumps' flow and,
/// within what is known of them, board and thermal camera. The turn about the jet cannot be seen
/// and stays nominal; the place along the jet hardly can: its prior holds it. Solved by Ceres.
class NozzleCalibrator {
 public:
  struct Config {
    double hfov_deg = 57.0;
    double noise_px = 0.15;
    double prior_m = 0.006, prior_deg = 0.4;  ///< of the mounting: tolerance of the workshop
    double flow_prior = 0.08;                 ///< of the pumps' flow, relative
    double board_prior_m = 0.003, board_prior_deg = 0.1;  ///< of the board that the LiDAR found
    int min_spots = 6;
    void visit(ConfigArchive& a);
  };
  explicit NozzleCalibrator(Config config) : config_(config) {}
  /// @param flange_thermal  the thermal camera as it was calibrated before.
  /// @return Error{Degenerate} with what is missing: spots, distances, rolled postures, or a jet
  /// that reaches the board; Error{InvalidInput} for numbers that are none.
  [[nodiscard]] Result<NozzleCalibration> calibrate(std::span<const LandedJet> landed,
                                                    const Eigen::Isometry3d& X_flange_nozzle,
                                                    const Extrinsics& flange_thermal,
                                                    const BoardPlane& board,
                                                    const JetPath& jet) const;

 private:
  Config config_;
};

}  // namespace kiln
