#pragma once

#include <memory>
#include <optional>

#include "robot/sim/colour_camera.h"
#include "robot/sim/fault_script.h"
#include "robot/sim/lidar_thread.h"
#include "robot/sim/thermal_sensor.h"
#include "robot/sim/world.h"

namespace kiln::sim {

/// Runs the requested sensors at their own rates and collects their frames. Confined to the world's
/// thread.
class SensorSuite {
 public:
  SensorSuite(const WorldConfig& config, const TrueArena& arena, const RobotGeometry& robot,
              const WetBoards& wet, std::uint64_t seed, bool render_colour);

  void request(const SensorRequest& request);
  /// After each physics step. @param drops called only when a picture needs them.
  void afterStep(const SceneState& state, const FaultScript& faults,
                 const std::function<std::vector<Eigen::Vector3d>()>& drops);
  void takeFrames(WorldReport& report);
  [[nodiscard]] std::optional<SceneState> takeColourDue(CameraMount camera);
  /// The scene for the water, not older than one LiDAR chunk.
  [[nodiscard]] const Raycaster& rays(const SceneState& state);
  /// Which of TrueArena::boxes a ray of rays() hit, if any.
  [[nodiscard]] std::optional<std::size_t> boxHit(const Raycaster::Hit& hit) const {
    return scene_.box(hit);
  }
  [[nodiscard]] const ThermalSensor& thermal() const { return thermal_; }

 private:
  void updateScene(const SceneState& state);
  void runLidar(const SceneState& state, const FaultScript& faults);
  void runThermal(const SceneState& state, const FaultScript& faults);
  /// One of the colour cameras.
  struct Eye {
    CameraMount mount;
    double rate_hz;
    std::unique_ptr<ColourCamera> camera;  ///< made at the first picture
    std::optional<Stamp> next;
    std::optional<SceneState> due;
  };
  void runColour(Eye& eye, const SceneState& state, const FaultScript& faults,
                 const std::function<std::vector<Eigen::Vector3d>()>& drops);

  WorldConfig config_;
  TrueArena arena_;
  RobotGeometry robot_;
  RayScene scene_;  ///< of the thermal camera and the water
  std::optional<Stamp> scene_of_;
  LidarThread lidar_;
  ThermalSensor thermal_;
  Eye mast_, head_;
  bool render_colour_;
  SensorRequest request_;
  std::optional<SceneState> chunk_start_;
  std::optional<Stamp> next_thermal_;
  WorldReport frames_;  ///< only its three frame lists
};

}  // namespace kiln::sim
