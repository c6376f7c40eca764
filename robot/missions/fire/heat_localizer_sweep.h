#pragma once

#include "robot/missions/fire/skills/heat_sweep.h"
#include "robot/perception/thermal/heat_localizer.h"

namespace kiln {

/// HeatLocalizer as the skills see it.
class HeatLocalizerSweep final : public HeatSweep {
 public:
  explicit HeatLocalizerSweep(HeatLocalizer::Config config) : localizer_(config) {}
  void begin() override { localizer_.begin(); }
  void add(const HeatDetections& detections, const Eigen::Isometry3d& X_map_thermal,
           const Eigen::Vector3d& normal_prior_map) override {
    localizer_.add(detections, X_map_thermal, normal_prior_map);
  }
  [[nodiscard]] std::optional<FireEstimate> estimate() const override {
    return localizer_.estimate();
  }

 private:
  HeatLocalizer localizer_;
};

}  // namespace kiln
