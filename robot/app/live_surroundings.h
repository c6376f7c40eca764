#pragma once

#include "common/core/bounded_queue.h"
#include "common/core/executor.h"
#include "robot/perception/cloud/box_locator.h"
#include "robot/perception/cloud/obstacle_memory.h"
#include "robot/perception/cloud/scan_window.h"
#include "robot/scene/arena_map.h"
#include "robot/skills/surroundings.h"

namespace kiln {

/// The live cloud as skills and missions see it: remembers obstacles, keeps a window of scans and
/// has the pool look for a fire box in it. Confined to the mission thread, the pool's work aside.
class LiveSurroundings final : public Surroundings {
 public:
  struct Config {
    ObstacleMemory::Config obstacles;
    ScanWindow::Config window;
    BoxLocator::Config locator;
    double locate_latency_s = 0.06;  ///< modelled in lockstep; median of its benchmark
    void visit(ConfigArchive& a);
  };
  /// @param sizes  of the fire places, from the arena.
  LiveSurroundings(const Config& config, const FireBoxSizes& sizes, Executor& executor);

  /// A prepared scan with where base and LiDAR were at its stamp.
  struct Scan {
    PointCloudPtr scan_base;
    ObstacleScan obstacles;  ///< made by ObstacleMemory::observe on the pool
    Pose2 X_odom_base;
    Eigen::Isometry3d X_map_base;
  };
  void add(const Scan& scan);
  /// Once a tick: takes answers, posts what could not be posted before.
  void tick(const Pose2& X_odom_base_now);
  /// The robot was carried to its start: nothing that was seen fits any more.
  void clear();

  [[nodiscard]] ObstacleCloudPtr obstacles() const override { return memory_.snapshot(); }
  [[nodiscard]] Pose2 X_odom_base() const override { return X_odom_base_; }
  void beginPlaceCheck(const std::string& place, const Eigen::Isometry3d& X_map_front) override;
  [[nodiscard]] std::optional<PlaceCheck> placeCheck() const override { return answer_; }

 private:
  struct Question {
    std::uint64_t number = 0;
    std::string place;
    Eigen::Isometry3d X_map_front;
  };
  struct Answer {
    std::uint64_t number = 0;
    PlaceCheck check;
  };
  void post();

  Config config_;
  Executor& executor_;
  BoxLocator locator_;
  ObstacleMemory memory_;
  ScanWindow window_;
  Pose2 X_odom_base_;
  Question question_;
  bool waiting_ = false;  ///< to be posted
  std::optional<PlaceCheck> answer_;
  BoundedQueue<Answer> answers_{4, DropPolicy::Oldest};
};

/// Sizes of the arena's fire places as the locator wants them.
[[nodiscard]] FireBoxSizes fireBoxSizes(const ArenaMap& arena);

}  // namespace kiln
