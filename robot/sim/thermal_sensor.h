#pragma once

#include <vector>

#include "common/model/sensor.h"
#include "robot/sim/random.h"
#include "robot/sim/ray_scene.h"
#include "robot/sim/wet_boards.h"

namespace kiln::sim {

/// Lepton 3.5: a frame of TLinear counts each 114 ms; while the shutter is closed the last frame is
/// sent again and the camera's counter stands still. Acrylic is opaque and mirrors a little.
/// Confined to one thread.
class ThermalSensor {
 public:
  /// @param wet boards that show water; kept by the caller.
  ThermalSensor(const ThermalConfig& config, const RobotGeometry& robot, const TrueRobot& truth,
                const WetBoards& wet, std::uint64_t seed);

  /// Time of the next frame after `now`.
  [[nodiscard]] Stamp nextFrame(Stamp now) const;
  /// @pre `scene` shows `state`. @param stuck scripted fault: nothing new, and no shutter to
  /// explain it.
  [[nodiscard]] ThermalImagePtr capture(const SceneState& state, const RayScene& scene, bool stuck);
  [[nodiscard]] bool shutterClosed(Stamp now) const;
  [[nodiscard]] Eigen::Isometry3d X_map_thermal(const SceneState& state) const;

 private:
  void castPixels(const SceneState& state, const RayScene& scene);
  void refineEdges(const Eigen::Isometry3d& X_map_thermal, const RayScene& scene);
  void mirrorOnAcrylic(std::span<const Raycaster::Ray> rays, std::span<const Raycaster::Hit> hits,
                       const RayScene& scene, std::vector<float>& celsius) const;
  [[nodiscard]] float surface(const Raycaster::Ray& ray, const Raycaster::Hit& hit,
                              const RayScene& scene) const;
  void blur();
  [[nodiscard]] std::vector<std::uint16_t> counts();

  ThermalConfig config_;
  RobotGeometry robot_;
  Eigen::Isometry3d X_flange_thermal_;
  const WetBoards& wet_;
  Stamp now_;
  CameraModel camera_;
  Random noise_;
  std::vector<float> fixed_pattern_k_, celsius_, row_;
  // In the order of the rays: square tiles of pixels.
  std::vector<std::size_t> pixels_;  ///< index in the picture
  std::vector<Eigen::Vector3f> pixel_rays_;
  std::vector<float> tiled_celsius_;
  std::vector<Raycaster::Ray> rays_;
  std::vector<Raycaster::Hit> hits_;
  double shutter_period_s_ = 180.0, shutter_first_s_ = 90.0;
  std::vector<std::uint16_t> last_;
  std::uint64_t seq_ = 0;
  std::uint32_t frame_counter_ = 0;
};

}  // namespace kiln::sim
