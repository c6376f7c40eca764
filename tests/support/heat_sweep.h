#pragma once

#include <optional>

#include "robot/perception/thermal/heat_detector.h"
#include "robot/perception/thermal/heat_localizer.h"
#include "tests/support/thermal_renderer.h"

namespace kiln::testing {

/// How far an estimate is off, seen from the last camera pose.
struct SweepError {
  double range_m = 0;
  double lateral_m = 0;
  double baseline_m = 0;   ///< the bounding-box distance's error
  double mahalanobis = 0;  ///< of the position error under the stated covariance
};

/// One arm sweep in front of a fire box, by seed: true poses render the pictures, the localizer
/// gets nominal ones. Camera 0.75 to 1.0 m from the plate and at most 10 deg off its axis, panning;
/// per seed the world's errors (extrinsics, box yaw, plate off centre).
class HeatSweep {
 public:
  struct Config {
    int views = 24;
    double extrinsic_m = 0.005, extrinsic_deg = 0.3;  ///< sigma per axis, fixed over the sweep
    double pose_m = 0.001, pose_deg = 0.05;  ///< sigma per axis and view: arm calibration, timing
    double box_yaw_deg = 5.0;                ///< uniform
    double off_centre_m = 0.003;             ///< uniform
    bool decoy = false;
    bool moving = true;  ///< false: the camera pans on the spot
  };
  explicit HeatSweep(std::uint64_t seed) : HeatSweep(seed, Config{}) {}
  HeatSweep(std::uint64_t seed, Config config);
  [[nodiscard]] std::optional<SweepError> run(HeatLocalizer::Config localizer);

 private:
  [[nodiscard]] double uniform(double half) {
    return std::uniform_real_distribution<>(-half, half)(random_);
  }
  [[nodiscard]] Eigen::Isometry3d small(double sigma_m, double sigma_deg);

  Config config_;
  std::mt19937_64 random_;
  ThermalRenderer renderer_;
};

}  // namespace kiln::testing
