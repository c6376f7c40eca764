#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <optional>

#include "common/core/bounded_queue.h"
#include "common/core/executor.h"
#include "robot/missions/common/mission_parts.h"
#include "robot/perception/marker/marker_localizer.h"

namespace kiln {

/// Gathers what the head camera shows of the wall's marker and has the pool make a pose of it
/// (NimbRo UGV paper, "Wall Marker Detection"). One job at a time owns detector and localizer.
/// onPicture() runs on the device's thread and only fills a mailbox; the rest is confined to the
/// mission thread.
class MarkerTask {
 public:
  struct Config {
    MarkerDetector::Config detector;
    MarkerLocalizer::Config localizer;
    GroundPlaneConfig ground;
    double latency_s = 0.08;                 ///< of a picture; modelled in lockstep
    double search_latency_s = 0.3;           ///< of the pose; modelled in lockstep
    Config() { localizer.window_s = 40.0; }  ///< one look with all its stops
    void visit(ConfigArchive& a);
  };
  MarkerTask(const Config& config, const MissionParts& parts);
  ~MarkerTask();

  void onPicture(RgbImagePtr image);
  /// Forgets everything and listens from now on.
  void begin(Stamp now);
  /// Listens no longer, and asks what all the pictures show.
  void ask();
  /// Of the last ask().
  [[nodiscard]] const std::optional<MarkerSearch>& answer() const { return answer_; }
  [[nodiscard]] bool listening() const { return listening_; }
  /// Pictures that were looked at, and those that showed a candidate on ground that the LiDAR saw.
  [[nodiscard]] int pictures() const { return pictures_; }
  [[nodiscard]] int candidates() const { return candidates_; }
  /// Once a tick: takes what is done, posts what waits.
  void tick();
  void clear();

 private:
  struct Eyes;
  struct Done {
    std::uint64_t number = 0;
    bool candidate = false;
    std::optional<MarkerSearch> search;
  };
  void dispatch();
  void look(const RgbImagePtr& image);

  Config config_;
  MissionParts parts_;
  std::shared_ptr<Eyes> eyes_;
  BoundedQueue<RgbImagePtr> images_{2, DropPolicy::Oldest};
  BoundedQueue<Done> done_{8, DropPolicy::Oldest};
  std::uint64_t number_ = 0;
  Stamp since_;
  bool listening_ = false, asked_ = false, busy_ = false;
  int pictures_ = 0, candidates_ = 0;
  std::optional<MarkerSearch> answer_;
};

}  // namespace kiln
