#pragma once

#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "common/geom/pose.h"
#include "common/wire/fire/fire_model.h"
#include "common/wire/fire/place_check.h"

namespace kiln {

/// What the fire mission adds to the mission report. Deterministic in lockstep.
class FireReport {
 public:
  /// The estimate of a sweep, if image `stamp` is the last one in it.
  void addEstimate(const std::optional<FireEstimate>& estimate, Stamp image,
                   const Eigen::Isometry3d& X_map_thermal);
  /// Configured against sensed; each answer once.
  void addPlaceCheck(const PlaceCheck& check);
  /// Keys heat_estimates and place_checks.
  void write(nlohmann::json& report) const;

 private:
  struct HeatRecord {
    Stamp stamp;                ///< of the last image in the estimate
    Eigen::Vector3d p_thermal;  ///< estimate in the believed camera frame at that stamp, m
    double range_m = 0.0, baseline_range_m = 0.0;
    int views = 0;
    std::string place;
  };
  std::vector<HeatRecord> heat_;
  std::vector<PlaceCheck> checks_;
};

}  // namespace kiln
