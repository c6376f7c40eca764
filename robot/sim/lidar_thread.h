#pragma once

#include <condition_variable>
#include <mutex>
#include <optional>
#include <thread>

#include "common/core/mutex.h"
#include "robot/sim/lidar_sensor.h"

namespace kiln::sim {

/// Casts one chunk of the LiDAR beside the world, which goes on with the next one meanwhile: the
/// rays are the dearest part of a simulated second. What a chunk shows depends on its two scene
/// states alone, and it is handed over at a fixed simulated time, so that runs stay repeatable.
/// post() and take() belong to the world's thread.
class LidarThread {
 public:
  LidarThread(const WorldConfig& config, const TrueArena& arena, const RobotGeometry& robot,
              std::uint64_t seed);

  /// Begins with the columns fired in (before, after]. @pre take() was called since the last
  /// post().
  void post(SceneState before, SceneState after);
  /// Waits for the posted chunk; the scan that ended in it, if one did.
  [[nodiscard]] PointCloudPtr take();
  void restart();

 private:
  struct Chunk {
    SceneState before, after;
  };
  void work(std::stop_token stop);

  RayScene scene_;
  LidarSensor sensor_;
  Mutex mutex_;
  std::condition_variable_any changed_;
  std::optional<Chunk> chunk_;  ///< in work until it is reset
  PointCloudPtr scan_;
  std::jthread thread_;  ///< last: joined before the rest goes
};

}  // namespace kiln::sim
