#include "robot/sim/picture_thread.h"

#include "common/core/scheduling.h"

namespace kiln::sim {

PictureThread::PictureThread(const WorldConfig& config, const TrueArena& arena,
                             const RobotGeometry& robot, CameraMount camera)
    : camera_(config, arena, robot, camera),
      thread_([this](std::stop_token stop) { work(stop); }) {}

void PictureThread::render(SceneState state) {
  {
    const std::lock_guard lock(mutex_);
    next_ = std::move(state);
  }
  wake_.notify_one();
}

void PictureThread::work(std::stop_token stop) {
  runAfterOthers();
  while (!stop.stop_requested()) {
    std::unique_lock lock(mutex_);
    if (!wake_.wait(lock, stop, [this] { return next_.has_value(); })) return;
    const SceneState state = *std::exchange(next_, std::nullopt);
    lock.unlock();
    done_.push(camera_.render(state));
  }
}

}  // namespace kiln::sim
