#pragma once

#include <cstdint>
#include <functional>

#include "common/core/bounded_queue.h"
#include "common/core/executor.h"
#include "robot/missions/fire/skills/place_look.h"
#include "robot/perception/cloud/box_locator.h"
#include "robot/scene/fire_site_map.h"

namespace kiln {

/// Has the pool look for a place's box in the scans of the last seconds. Confined to the mission
/// thread, the pool's work aside.
class PlaceTask final : public PlaceLook {
 public:
  struct Config {
    BoxLocator::Config locator;
    double latency_s = 0.06;  ///< modelled in lockstep; median of its benchmark
    void visit(ConfigArchive& a);
  };
  /// The prepared scans of the last seconds, oldest first.
  using Scans = std::function<std::deque<ScanWindow::Entry>()>;
  PlaceTask(const Config& config, const FireSiteMap& site, Scans scans, Executor& executor);

  void begin(const std::string& place, const Eigen::Isometry3d& X_map_front) override;
  [[nodiscard]] std::optional<PlaceCheck> answer() const override { return answer_; }
  /// Once a tick: takes answers, posts what could not be posted before.
  void tick();
  /// The robot was carried: what was asked no longer matters.
  void clear();

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

  double latency_s_;
  Executor& executor_;
  Scans scans_;
  BoxLocator locator_;
  Question question_;
  bool waiting_ = false;  ///< to be posted
  std::optional<PlaceCheck> answer_;
  BoundedQueue<Answer> answers_{4, DropPolicy::Oldest};
};

}  // namespace kiln
