#include "robot/app/preflight.h"

#include <gtest/gtest.h>

namespace kiln {
namespace {

PreflightInputs healthy() {
  PreflightInputs in;
  in.devices_connected = true;
  in.arm_age_s = in.base_age_s = in.pumps_age_s = 0.01;
  in.lidar_age_s = in.thermal_age_s = 0.1;
  in.pose_health = PoseHealth::Good;
  in.battery_v = 29.0;
  return in;
}

TEST(Preflight, PassesAHealthyRobot) {
  const auto checks = preflight(healthy(), {});
  EXPECT_TRUE(allOk(checks)) << firstFailure(checks);
  EXPECT_EQ(firstFailure(checks), "");
}

TEST(Preflight, NamesEachFailureWithWhatToDo) {
  struct Case {
    std::string name;
    std::function<void(PreflightInputs&)> breakIt;
  };
  const std::vector<Case> cases = {
      {"Devices", [](auto& in) { in.devices_connected = false; }},
      {"Arm", [](auto& in) { in.arm_age_s.reset(); }},
      {"Arm safety", [](auto& in) { in.arm_safety = ArmSafetyMode::ProtectiveStop; }},
      {"Base", [](auto& in) { in.base_age_s = 1.0; }},
      {"Pumps", [](auto& in) { in.pumps_age_s = 1.0; }},
      {"LiDAR", [](auto& in) { in.lidar_age_s = 2.1; }},
      {"Thermal camera", [](auto& in) { in.thermal_age_s = 3.0; }},
      {"Position", [](auto& in) { in.pose_health = PoseHealth::Degraded; }},
      {"Battery", [](auto& in) { in.battery_v = 20.0; }},
      {"Storage", [](auto& in) { in.storage_ok = false; }},
  };
  for (const Case& c : cases) {
    PreflightInputs in = healthy();
    c.breakIt(in);
    const auto checks = preflight(in, {});
    EXPECT_FALSE(allOk(checks)) << c.name;
    EXPECT_EQ(firstFailure(checks).rfind(c.name + ": ", 0), 0U) << firstFailure(checks);
  }
}

}  // namespace
}  // namespace kiln
