#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/core/bounded_queue.h"
#include "common/core/executor.h"
#include "common/core/latest_value.h"
#include "common/core/log.h"
#include "common/model/scene.h"
#include "common/model/status.h"
#include "robot/app/operator_link.h"
#include "robot/scene/arena_map.h"

namespace kiln {

/// Decides what is published when. Values come as const snapshots at the end of the mission tick;
/// encoding of pictures runs on the pool, everything else on the link's own thread. Confined to the
/// mission thread but for onPicture().
class TelemetryHub {
 public:
  struct Config {
    double status_rate_hz = 10.0;
    double fsm_rate_hz = 10.0;
    double scene_rate_hz = 5.0;
    double trajectory_rate_hz = 1.0;
    double picture_rate_hz = 10.0;
    int jpeg_quality = 75;
  };
  /// @param link  may be null: nothing is published.
  TelemetryHub(Config config, OperatorLink* link, Executor& executor);

  /// True at most so often; the caller builds the value only then.
  [[nodiscard]] bool statusDue(Stamp now) { return due(last_status_, config_.status_rate_hz, now); }
  [[nodiscard]] bool fsmDue(Stamp now, std::uint64_t step);
  [[nodiscard]] bool sceneDue(Stamp now) { return due(last_scene_, config_.scene_rate_hz, now); }

  [[nodiscard]] bool localizationDue(Stamp now) {
    return due(last_localization_, config_.status_rate_hz, now);
  }
  [[nodiscard]] bool trajectoryDue(Stamp now) {
    return due(last_trajectory_, config_.trajectory_rate_hz, now);
  }

  void publish(RobotStatus status) {
    if (link_) link_->publish(std::move(status));
  }
  void publish(FsmInfo info) {
    if (link_) link_->publish(std::move(info));
  }
  void publish(MissionInfo info) {
    if (link_) link_->publish(std::move(info));
  }
  void publish(FsmStatus status) {
    if (link_) link_->publish(std::move(status));
  }
  void publish(Scene scene) {
    if (link_) link_->publish(std::move(scene));
  }
  void publish(std::vector<MacroInfo> macros) {
    if (link_) link_->publish(std::move(macros));
  }
  void publish(LocalizationStatus status) {
    if (link_) link_->publish(std::move(status));
  }
  void publish(Trajectory trajectory) {
    if (link_) link_->publish(std::move(trajectory));
  }
  void publish(std::shared_ptr<const MapLayer> layer) {
    if (link_) link_->publish(std::move(layer));
  }
  void publish(PointCloudPtr cloud) {
    if (link_) link_->publish(std::move(cloud));
  }
  void publish(ThermalImagePtr image) {
    if (link_) link_->publish(std::move(image));
  }
  void publish(MissionDetail detail) {
    if (link_) link_->publish(std::move(detail));
  }
  /// Any thread: encodes on the pool and sends, if somebody watches this camera.
  void onPicture(RgbImagePtr image);
  /// Collects log lines for the station; any thread.
  void onLog(const LogRecord& record, Stamp now);
  void flushLog(Stamp now);
  [[nodiscard]] std::optional<Stamp> lastPicture() const { return last_picture_.peek(); }

 private:
  [[nodiscard]] bool due(std::optional<Stamp>& last, double rate_hz, Stamp now);

  Config config_;
  OperatorLink* link_;
  Executor& executor_;
  std::optional<Stamp> last_status_, last_fsm_, last_scene_, last_log_, last_localization_,
      last_trajectory_;
  std::uint64_t last_step_ = 0;
  LatestValue<Stamp> last_picture_, last_head_picture_;
  BoundedQueue<LogLine> log_{256, DropPolicy::Oldest};
};

/// The nominal arena as boxes to draw: walls, furniture, fire tables.
[[nodiscard]] std::vector<SceneBox> sceneBoxes(const ArenaMap& arena);

}  // namespace kiln
