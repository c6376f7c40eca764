#include "robot/app/preflight.h"

#include <algorithm>

namespace kiln {
namespace {

Check ageCheck(const std::string& name, std::optional<double> age_s, double limit_s,
               const std::string& advice) {
  if (!age_s) return {name, false, "no data yet; " + advice};
  if (*age_s > limit_s)
    return {name, false, fmt::format("no data for {:.1f} s; {}", *age_s, advice)};
  return {name, true, fmt::format("{:.2f} s old", *age_s)};
}

}  // namespace

void PreflightLimits::visit(ConfigArchive& a) {
  a.field("device_age_s", device_age_s, "s", 0.01, 5, "oldest allowed arm, base or pump state");
  a.field("lidar_age_s", lidar_age_s, "s", 0.1, 10, "oldest allowed LiDAR scan");
  a.field("thermal_age_s", thermal_age_s, "s", 0.1, 10, "oldest allowed thermal image");
  a.field("battery_min_v", battery_min_v, "V", 0, 60, "start no mission below");
}

std::vector<Check> preflight(const PreflightInputs& in, const PreflightLimits& limits) {
  std::vector<Check> checks;
  checks.push_back(
      {"Devices", in.devices_connected,
       in.devices_connected ? "connected" : "no connection; is kiln-sim or the robot's power on?"});
  checks.push_back(ageCheck("Arm", in.arm_age_s, limits.device_age_s, "check the arm controller"));
  const bool arm_normal =
      in.arm_safety == ArmSafetyMode::Normal || in.arm_safety == ArmSafetyMode::Reduced;
  checks.push_back({"Arm safety", arm_normal,
                    arm_normal ? std::string(toString(in.arm_safety))
                               : fmt::format("{}; look at the arm, then release it by hand",
                                             toString(in.arm_safety))});
  checks.push_back(
      ageCheck("Base", in.base_age_s, limits.device_age_s, "check the wheel controllers"));
  checks.push_back(
      ageCheck("Pumps", in.pumps_age_s, limits.device_age_s, "check the pump controller"));
  checks.push_back(
      ageCheck("LiDAR", in.lidar_age_s, limits.lidar_age_s, "check its cable and power"));
  Check thermal =
      ageCheck("Thermal camera", in.thermal_age_s, limits.thermal_age_s, "check its USB cable");
  if (thermal.ok && !in.thermal_usable) thermal = {"Thermal camera", false, in.thermal_refusal};
  checks.push_back(thermal);
  const bool located = in.pose_health == PoseHealth::Good;
  checks.push_back(
      {"Position", located,
       located ? "good"
               : fmt::format("{}; is the robot in its start zone?", toString(in.pose_health))});
  const bool charged = in.battery_v >= limits.battery_min_v;
  checks.push_back(
      {"Battery", charged,
       fmt::format("{:.1f} V{}", in.battery_v, charged ? "" : "; change the battery")});
  checks.push_back({"Storage", in.storage_ok,
                    in.storage_ok ? "writable" : "checkpoint cannot be written; free some space"});
  return checks;
}

bool allOk(const std::vector<Check>& checks) {
  return std::all_of(checks.begin(), checks.end(), [](const Check& check) { return check.ok; });
}

std::string firstFailure(const std::vector<Check>& checks) {
  for (const Check& check : checks) {
    if (!check.ok) return check.name + ": " + check.detail;
  }
  return {};
}

}  // namespace kiln
