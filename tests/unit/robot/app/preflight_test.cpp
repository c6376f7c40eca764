#include "robot/app/preflight.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace kiln {
namespace {

PreflightInputs healthy() {
  PreflightInputs in;
  in.devices_connected = true;
  in.arm_age_s = in.base_age_s = in.pumps_age_s = 0.01;
  in.lidar_age_s = 0.1;
  in.cloud_age_s = 0.2;
  in.pose_health = PoseHealth::Good;
  in.fence_room_m = 1.4;
  in.battery_v = 29.0;
  in.tree_edges = 10;
  in.clocks = {{"the LiDAR", 0.0}, {"Ann's station", 0.004}};
  in.pumps = PumpsState{};
  in.limits = {{"base.max_speed_mps", 1.0, 4.0, "m/s", "hub motors"}};
  in.map_fit = MapFit{0.95, 0.011};
  in.disk_free_gb = 40.0;
  in.recording_needs_gb = 2.0;
  return in;
}

Check rowOf(const PreflightInputs& in, const std::string& name) {
  for (const Check& check : preflight(in, {})) {
    if (check.name == name) return check;
  }
  ADD_FAILURE() << "no row '" << name << "'";
  return {};
}

TEST(Preflight, PassesAHealthyRobot) {
  const auto checks = preflight(healthy(), {});
  EXPECT_TRUE(allOk(checks)) << firstFailure(checks);
  EXPECT_EQ(firstFailure(checks), "");
  for (const Check& check : checks) {
    EXPECT_FALSE(check.warn) << check.name;
    EXPECT_NE(check.detail, "") << check.name << ": the measured value";
    EXPECT_EQ(check.action, "") << check.name << ": nothing to do";
  }
}

TEST(Preflight, NamesASilentDevice) {
  PreflightInputs in = healthy();
  EXPECT_EQ(silentDevice(in, {}), "");
  in.arm_age_s.reset();
  EXPECT_EQ(silentDevice(in, {}), "no state of the arm yet");
  in.base_age_s = 1.25;
  EXPECT_EQ(silentDevice(in, {}), "no state of the base for 1.2 s");
  in = healthy();
  in.pumps_age_s.reset();
  EXPECT_EQ(silentDevice(in, {}), "no state of the pumps yet");
  in.has_pumps = false;
  EXPECT_EQ(silentDevice(in, {}), "");
}

TEST(Preflight, NamesWhoWritesEachActuator) {
  const std::vector<ActuatorWriter> actuators{
      {"base", Writer::Program}, {"arm", Writer::Hand}, {"pumps", std::nullopt}};
  const Check mission = writersCheck(actuators, Mode::Autonomous);
  EXPECT_EQ(mission.detail, "base: mission, arm: teleop, pumps: nobody");
  EXPECT_TRUE(mission.ok);
  EXPECT_EQ(writersCheck(actuators, Mode::Teleop).detail,
            "base: macro, arm: teleop, pumps: nobody");
}

TEST(Preflight, NamesTheDevicesThatTheMissionLacks) {
  PreflightInputs in = healthy();
  in.lacking = {DeviceKind::Pumps, DeviceKind::ThermalCamera};
  EXPECT_EQ(firstFailure(preflight(in, {})),
            "Devices: this mission needs pumps and a thermal camera, which this robot does not "
            "have; start another mission");
}

TEST(Preflight, ARobotWithoutPumpsIsNotAskedForThem) {
  PreflightInputs in = healthy();
  in.pumps.reset();
  in.pumps_age_s.reset();
  EXPECT_FALSE(allOk(preflight(in, {})));
  in.has_pumps = false;
  EXPECT_TRUE(allOk(preflight(in, {}))) << firstFailure(preflight(in, {}));
}

TEST(Preflight, NamesEachFailureWithWhatToDo) {
  struct Case {
    std::string name;
    std::function<void(PreflightInputs&)> breakIt;
  };
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  const std::vector<Case> cases = {
      {"Devices", [](auto& in) { in.devices_connected = false; }},
      {"Arm", [](auto& in) { in.arm_age_s.reset(); }},
      {"Arm safety", [](auto& in) { in.arm_safety = ArmSafetyMode::ProtectiveStop; }},
      {"Base", [](auto& in) { in.base_age_s = 1.0; }},
      {"Pumps", [](auto& in) { in.pumps_age_s = 1.0; }},
      {"Pump current", [](auto& in) { in.pumps.reset(); }},
      {"Pump current", [](auto& in) { in.pumps->current_a[1] = 3.0; }},
      {"Pump current", [&](auto& in) { in.pumps->current_a[0] = kNaN; }},
      {"Pump current", [](auto& in) { in.pumps->heartbeat_lost = true; }},
      {"LiDAR", [](auto& in) { in.lidar_age_s = 2.1; }},
      {"Perception", [](auto& in) { in.cloud_age_s = 1.4; }},
      {"Perception", [](auto& in) { in.cloud_age_s.reset(); }},
      {"Transforms", [](auto& in) { in.missing_edges = {"flange -> lidar"}; }},
      {"Geofence", [](auto& in) { in.fence_room_m.reset(); }},
      {"Geofence", [](auto& in) { in.fence_room_m = -0.1; }},
      {"Geofence", [&](auto& in) { in.fence_room_m = kNaN; }},
      {"Clocks", [](auto& in) { in.clocks[1].error_s = -2.0; }},
      {"Clocks", [&](auto& in) { in.clocks[0].error_s = kNaN; }},
      {"Controller limits", [](auto& in) { in.limits[0].configured = 5.0; }},
      {"Controller limits", [](auto& in) { in.reported_beyond_limit = "joint 3 stands at 359"; }},
      {"Position", [](auto& in) { in.pose_health = PoseHealth::Degraded; }},
      {"Map against scan", [](auto& in) { in.map_fit.reset(); }},
      {"Map against scan", [](auto& in) { in.map_fit->inlier_fraction = 0.31; }},
      {"Battery", [](auto& in) { in.battery_v = 20.0; }},
      {"Disk", [](auto& in) { in.disk_free_gb = 0.1; }},
      {"Storage", [](auto& in) { in.storage_ok = false; }},
  };
  for (const Case& c : cases) {
    PreflightInputs in = healthy();
    c.breakIt(in);
    const auto checks = preflight(in, {});
    EXPECT_FALSE(allOk(checks)) << c.name;
    const Check row = rowOf(in, c.name);
    EXPECT_FALSE(row.ok) << c.name;
    EXPECT_NE(row.detail, "") << c.name;
    EXPECT_NE(row.action, "") << c.name << ": what to do";
    EXPECT_EQ(firstFailure(checks), c.name + ": " + row.detail + "; " + row.action);
  }
}

TEST(Preflight, WarnsOfWhatDoesNotForbidAStart) {
  struct Case {
    std::string name;
    std::function<void(PreflightInputs&)> doubt;
  };
  const std::vector<Case> cases = {
      {"Arm safety", [](auto& in) { in.arm_safety = ArmSafetyMode::Reduced; }},
      {"LiDAR",
       [](auto& in) {
         in.lidar_defects = {"6 packets lost", 0.12};
       }},
      {"Clocks", [](auto& in) { in.clocks[1].error_s.reset(); }},
      {"Controller limits",
       [](auto& in) {
         in.limits = {{"teleop.max_speed_mps", 2, 1, "m/s", "base", false, true}};
       }},
      {"Map against scan", [](auto& in) { in.map_fit->inlier_fraction = 0.45; }},
      {"Map against scan", [](auto& in) { in.map_fit->rms_m = 0.08; }},
      {"Map against scan", [](auto& in) { in.map_in_use = false; }},
      {"Disk", [](auto& in) { in.disk_free_gb = 1.0; }},
      {"Disk", [](auto& in) { in.disk_free_gb.reset(); }},
  };
  for (const Case& c : cases) {
    PreflightInputs in = healthy();
    c.doubt(in);
    const Check row = rowOf(in, c.name);
    EXPECT_TRUE(row.ok && row.warn) << c.name << ": " << row.detail;
    EXPECT_NE(row.action, "") << c.name;
    EXPECT_TRUE(allOk(preflight(in, {}))) << c.name;
  }
}

TEST(Preflight, SaysWhatWasMeasured) {
  PreflightInputs in = healthy();
  in.missing_edges = {"flange -> lidar", "flange -> nozzle"};
  EXPECT_EQ(rowOf(in, "Transforms").detail, "flange -> lidar, flange -> nozzle are missing");
  in.clocks[1].error_s = -2.0;
  EXPECT_EQ(rowOf(in, "Clocks").detail, "Ann's station is 2000 ms ahead");
  in.pumps->current_a = {3.2, 0.0};
  EXPECT_EQ(rowOf(in, "Pump current").detail, "left pump draws 3.2 A at rest");
  in.pumps->duty = {1.0, 0.0};  // sprayed by hand
  EXPECT_EQ(rowOf(in, "Pump current").detail, "3.2 and 0.0 A, running");
  in.lidar_defects = {"1 refused (data packet has 5 bytes)", 0.0};
  EXPECT_EQ(rowOf(in, "LiDAR").detail, "0.10 s old; 1 refused (data packet has 5 bytes)");
  EXPECT_FALSE(rowOf(in, "LiDAR").warn);
  in.map_fit = MapFit{0.31, 0.02};
  EXPECT_EQ(rowOf(in, "Map against scan").detail, "31 % fits, 20 mm rms");
}

}  // namespace
}  // namespace kiln
