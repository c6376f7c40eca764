#include "robot/sim/sensor_suite.h"

#include <algorithm>

namespace kiln::sim {

SensorSuite::SensorSuite(const WorldConfig& config, const TrueArena& arena,
                         const RobotGeometry& robot, const WetBoards& wet, std::uint64_t seed,
                         bool render_colour)
    : config_(config),
      arena_(arena),
      robot_(robot),
      scene_(config, arena, robot, false),
      lidar_(config, arena, robot, seed),
      thermal_(config.thermal, robot, arena.robot, wet, seed),
      mast_{CameraMount::Mast, config.camera.rate_hz, nullptr, {}, {}},
      head_{CameraMount::Head, config.head_camera.rate_hz, nullptr, {}, {}},
      render_colour_(render_colour) {}

void SensorSuite::request(const SensorRequest& request) {
  if (!request.lidar || !request_.lidar) {
    lidar_.restart();
    chunk_start_.reset();
  }
  if (!request.thermal) next_thermal_.reset();
  if (!request.operator_camera) mast_.next.reset();
  if (!request.head_camera) head_.next.reset();
  request_ = request;
}

void SensorSuite::runLidar(const SceneState& state, const FaultScript& faults) {
  if (!chunk_start_) {
    chunk_start_ = state;
    return;
  }
  if (toSeconds(state.stamp - chunk_start_->stamp) < config_.lidar.chunk_s - 1e-9) return;
  // A chunk is handed over when the next one has been fired: 20 ms for the way from the sensor.
  PointCloudPtr scan = lidar_.take();
  lidar_.post(*chunk_start_, state);
  chunk_start_ = state;
  if (scan && !faults.active("lidar_dropout", state.stamp))
    frames_.lidar.push_back(std::move(scan));
}

const Raycaster& SensorSuite::rays(const SceneState& state) {
  if (!scene_of_ || toSeconds(state.stamp - *scene_of_) >= config_.lidar.chunk_s)
    updateScene(state);
  return scene_.rays();
}

void SensorSuite::updateScene(const SceneState& state) {
  scene_.update(state);
  scene_of_ = state.stamp;
}

void SensorSuite::runThermal(const SceneState& state, const FaultScript& faults) {
  if (!next_thermal_) next_thermal_ = thermal_.nextFrame(state.stamp);
  if (state.stamp < *next_thermal_) return;
  updateScene(state);
  frames_.thermal.push_back(
      thermal_.capture(state, scene_, faults.active("thermal_freeze", state.stamp)));
  next_thermal_ = thermal_.nextFrame(state.stamp);
}

void SensorSuite::runColour(Eye& eye, const SceneState& state, const FaultScript& faults,
                            const std::function<std::vector<Eigen::Vector3d>()>& drops) {
  const Duration period = fromSeconds(1.0 / eye.rate_hz);
  if (!eye.next) eye.next = state.stamp + period;
  if (state.stamp < *eye.next) return;
  eye.next = std::max(*eye.next + period, state.stamp + period / 2);
  if (faults.active("camera_freeze", state.stamp)) return;
  SceneState picture = state;
  picture.drops = drops();
  if (!render_colour_) {
    eye.due = std::move(picture);
    return;
  }
  if (!eye.camera) eye.camera = std::make_unique<ColourCamera>(config_, arena_, robot_, eye.mount);
  frames_.colour.push_back(eye.camera->render(picture));
}

void SensorSuite::afterStep(const SceneState& state, const FaultScript& faults,
                            const std::function<std::vector<Eigen::Vector3d>()>& drops) {
  if (request_.lidar) runLidar(state, faults);
  if (request_.thermal) runThermal(state, faults);
  if (request_.operator_camera) runColour(mast_, state, faults, drops);
  if (request_.head_camera) runColour(head_, state, faults, drops);
}

void SensorSuite::takeFrames(WorldReport& report) {
  report.lidar = std::exchange(frames_.lidar, {});
  report.thermal = std::exchange(frames_.thermal, {});
  report.colour = std::exchange(frames_.colour, {});
}

std::optional<SceneState> SensorSuite::takeColourDue(CameraMount camera) {
  return std::exchange(camera == CameraMount::Mast ? mast_.due : head_.due, std::nullopt);
}

}  // namespace kiln::sim
