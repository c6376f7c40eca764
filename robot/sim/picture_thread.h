#pragma once

#include <condition_variable>
#include <mutex>
#include <optional>
#include <thread>

#include "common/core/bounded_queue.h"
#include "robot/sim/colour_camera.h"

namespace kiln::sim {

/// Renders one camera's pictures beside the world, at a lower priority: physics and devices come first.
/// A picture that is asked for while the last one is still in work replaces the waiting one.
/// Thread-safe.
class PictureThread {
 public:
  PictureThread(const WorldConfig& config, const TrueArena& arena, const RobotGeometry& robot,
                CameraMount camera);
  void render(SceneState state);
  [[nodiscard]] std::vector<RgbImagePtr> finished() { return done_.drain(); }

 private:
  void work(std::stop_token stop);

  ColourCamera camera_;
  std::mutex mutex_;
  std::condition_variable_any wake_;
  std::optional<SceneState> next_;
  BoundedQueue<RgbImagePtr> done_{2, DropPolicy::Oldest};
  std::jthread thread_;  ///< last: joined before the rest goes
};

}  // namespace kiln::sim
