#pragma once

#include <memory>

#include "common/config/config_archive.h"
#include "common/model/sensor.h"
#include "common/wire/fire/fire_model.h"

namespace kiln {

/// Threshold and blob analysis of one kelvin image (NimbRo UGV paper, "Heat Source Detection").
/// Refuses frozen and un-linearised frames; lists what it rejects with the reason. Keeps only what
/// is needed to notice a frozen stream and a flickering flame; confined to one thread.
class HeatDetector {
 public:
  struct Config {
    double threshold_c = 75.0;  ///< accepted peaks are hotter
    double report_c = 40.0;     ///< cooler blobs are not even listed
    int min_area_px = 6;
    double reflection_ratio =
        0.75;  ///< a cooler blob beside a hotter one, mirrored shape, at most this of its excess
    double reflection_likeness =
        0.7;                       ///< correlation of the mirrored heat profiles that marks a copy
    double flame_flicker_k = 8.0;  ///< frame-to-frame change that marks a flame
    double modelled_latency_s = 0.004;
    void visit(ConfigArchive& a);
  };
  explicit HeatDetector(Config config);
  ~HeatDetector();
  HeatDetector(HeatDetector&&) noexcept;
  HeatDetector& operator=(HeatDetector&&) noexcept;
  /// Each frame once, in order: a frame counter that stands still means a frozen camera. `cost_ms`
  /// stays 0 (the caller has the clock). Cost: tests/bench/perception_thermal_bench.
  [[nodiscard]] HeatDetections detect(const ThermalImage& image);
  void reset();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace kiln
