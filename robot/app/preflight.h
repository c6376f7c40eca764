#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/model/status.h"
#include "robot/localization/pose_tracker.h"

namespace kiln {

/// What the preflight checks look at; gathered by the mission tick. Ages in seconds, nullopt =
/// never seen.
struct PreflightInputs {
  bool devices_connected = false;
  std::optional<double> arm_age_s, base_age_s, pumps_age_s, lidar_age_s, thermal_age_s;
  ArmSafetyMode arm_safety = ArmSafetyMode::Normal;
  bool thermal_usable = true;
  std::string thermal_refusal;
  PoseHealth pose_health = PoseHealth::Lost;
  double battery_v = 0.0;
  bool storage_ok = true;
};

struct PreflightLimits {
  double device_age_s = 0.2;
  double lidar_age_s = 0.5;
  double thermal_age_s = 1.5;   ///< longer than one shutter freeze
  double battery_min_v = 25.6;  ///< 3.2 V a cell
  void visit(ConfigArchive& a);
};

/// One row a check, each with what to do when it fails. All must hold before a mission starts.
[[nodiscard]] std::vector<Check> preflight(const PreflightInputs& inputs,
                                           const PreflightLimits& limits);
[[nodiscard]] bool allOk(const std::vector<Check>& checks);
/// "LiDAR: no scan for 2.1 s; check cable and power" or empty.
[[nodiscard]] std::string firstFailure(const std::vector<Check>& checks);

}  // namespace kiln
