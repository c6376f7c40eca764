#include "robot/sim/lidar_thread.h"

#include <algorithm>
#include <utility>

namespace kiln::sim {
namespace {

/// Bodies stand in the middle of the chunk; the sensor itself moves with every column.
SceneState between(const SceneState& a, const SceneState& b) {
  SceneState mid = b;
  mid.stamp = a.stamp + (b.stamp - a.stamp) / 2;
  mid.X_map_base = interpolate(a.X_map_base, b.X_map_base, 0.5);
  mid.q = 0.5 * (a.q + b.q);
  for (std::size_t i = 0; i < std::min(a.bricks.size(), b.bricks.size()); ++i)
    if (a.bricks[i].matrix() != b.bricks[i].matrix())
      mid.bricks[i] = interpolate(a.bricks[i], b.bricks[i], 0.5);
  return mid;
}

}  // namespace

LidarThread::LidarThread(const WorldConfig& config, const TrueArena& arena,
                         const RobotGeometry& robot, std::uint64_t seed)
    : scene_(config, arena, robot, false),
      sensor_(config.lidar, robot, arena.robot, seed),
      thread_([this](std::stop_token stop) { work(stop); }) {}

void LidarThread::post(SceneState before, SceneState after) {
  {
    const std::lock_guard lock(mutex_);
    chunk_ = Chunk{std::move(before), std::move(after)};
  }
  changed_.notify_all();
}

PointCloudPtr LidarThread::take() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return !chunk_.has_value(); });
  return std::exchange(scan_, nullptr);
}

void LidarThread::restart() {
  (void)take();
  sensor_.restart();
}

void LidarThread::work(std::stop_token stop) {
  std::unique_lock lock(mutex_);
  while (changed_.wait(lock, stop, [this] { return chunk_.has_value(); })) {
    const Chunk chunk = *chunk_;
    lock.unlock();
    scene_.update(between(chunk.before, chunk.after));
    PointCloudPtr scan = sensor_.advance(chunk.before, chunk.after, scene_);
    lock.lock();
    scan_ = std::move(scan);
    chunk_.reset();
    changed_.notify_all();
  }
}

}  // namespace kiln::sim
