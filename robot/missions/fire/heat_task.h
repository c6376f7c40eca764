#pragma once

#include <atomic>
#include <optional>
#include <vector>

#include "common/core/bounded_queue.h"
#include "common/core/executor.h"
#include "common/model/sensor.h"
#include "common/model/status.h"
#include "common/wire/fire/fire_model.h"
#include "robot/missions/fire/heat_localizer_sweep.h"
#include "robot/perception/thermal/heat_detector.h"

namespace kiln {

/// What the fire mission makes of thermal images: each one goes through the heat detector on the
/// pool. onThermal() runs on the device's thread and only fills a mailbox; the rest is confined to
/// the mission thread.
class HeatTask {
 public:
  struct Config {
    HeatDetector::Config detector;
    HeatLocalizer::Config localizer;
    double image_age_s = 1.5;      ///< oldest image; longer than one shutter freeze
    double detection_age_s = 1.0;  ///< what a detection may be late by while images arrive
    void visit(ConfigArchive& a);
  };
  struct Result {
    ThermalImagePtr image;
    HeatDetections detections;
  };
  HeatTask(const Config& config, Executor& executor);

  void onThermal(ThermalImagePtr image);
  /// Posts a job for what has arrived.
  void dispatch();
  [[nodiscard]] std::vector<Result> take();
  [[nodiscard]] HeatSweep& sweep() { return sweep_; }
  /// Rows "Thermal camera" and "Heat detection".
  [[nodiscard]] std::vector<Check> checks(Stamp now) const;
  /// What is owed: images arrive and nothing is made of them. Empty: it keeps up, or the camera is
  /// silent, which is its own row.
  [[nodiscard]] std::string late(Stamp now) const;
  [[nodiscard]] std::uint64_t droppedFrames() const;

 private:
  Config config_;
  Executor& executor_;
  HeatDetector detector_;
  HeatLocalizerSweep sweep_;
  BoundedQueue<ThermalImagePtr> images_{4, DropPolicy::Oldest};
  BoundedQueue<Result> results_{8, DropPolicy::Oldest};
  std::optional<Stamp> last_image_, last_detection_, last_usable_;
  std::string refusal_, advice_;  ///< of the newest image; empty: it was usable
  std::uint64_t refused_jobs_ = 0;
};

}  // namespace kiln
