#pragma once

#include <cstdint>
#include <random>
#include <vector>

#include "common/model/sensor.h"

namespace kiln::testing {

/// A warm disc that always faces the camera.
struct WarmDisc {
  Eigen::Vector3d p_map = Eigen::Vector3d::Zero();
  double radius_m = 0.1;
  double kelvin = 330;
};

/// A hot plate behind the round opening of an opaque box, seen by a Lepton. Plate frame: origin in
/// the plate's centre, Z out through the opening, X horizontal.
struct ThermalScene {
  Eigen::Isometry3d X_map_plate = Eigen::Isometry3d::Identity();
  double plate_m = 0.15, opening_m = 0.15, recess_m = 0.10, box_m = 0.40;
  Eigen::Vector2d opening_offset_m =
      Eigen::Vector2d::Zero();  ///< of the opening's centre beside the plate's axis
  double ambient_k = 298.15;
  double plate_k = 400.0;
  double flame_k = 0.0;         ///< silk strip above the plate, inside the box; 0 = none
  std::vector<WarmDisc> discs;  ///< outside the box
};

/// Draws what the camera would see, by ray sampling (6 x 6 rays a pixel), with optical blur, white
/// noise and a fixed pattern. Independent of the simulator, so that neither can share the other's
/// mistakes.
class ThermalRenderer {
 public:
  struct Config {
    double hfov_deg = 57.0;
    double blur_px = 0.5;
    double noise_k = 0.05;
    double fixed_pattern_k = 0.3;
  };
  ThermalRenderer(Config config, std::uint64_t seed);
  /// The next frame: seq and frame counter go up by one.
  [[nodiscard]] ThermalImage render(const ThermalScene& scene,
                                    const Eigen::Isometry3d& X_map_thermal);
  [[nodiscard]] const CameraModel& camera() const { return camera_; }

 private:
  Config config_;
  CameraModel camera_;
  std::mt19937_64 random_;
  std::vector<float> fixed_pattern_;
  std::uint64_t seq_ = 0;
};

/// Pose of a camera at `eye` that looks at `target`, its X axis level.
[[nodiscard]] Eigen::Isometry3d lookAt(const Eigen::Vector3d& eye, const Eigen::Vector3d& target);

}  // namespace kiln::testing
