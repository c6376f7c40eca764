#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/model/status.h"
#include "robot/app/controller_limits.h"
#include "robot/control/writer.h"
#include "robot/hal/device_set.h"
#include "robot/hal/lidar.h"
#include "robot/localization/pose_tracker.h"

namespace kiln {

/// How well a clock agrees with the robot's.
struct ClockReading {
  std::string of;                 ///< "the LiDAR", "Ann's station"
  std::optional<double> error_s;  ///< robot minus it, what a round trip may hide taken off;
                                  ///< nullopt: not known yet
};

/// How the map explained the newest scan.
struct MapFit {
  double inlier_fraction = 0.0;
  double rms_m = 0.0;
};

/// What the preflight checks look at; gathered by the mission tick. Ages in seconds, nullopt =
/// never seen.
struct PreflightInputs {
  bool devices_connected = false;
  std::optional<double> arm_age_s, base_age_s, pumps_age_s, lidar_age_s;
  /// Age of the newest cloud that perception has delivered, by the stamp of its scan.
  std::optional<double> cloud_age_s;
  LidarDefects lidar_defects;
  ArmSafetyMode arm_safety = ArmSafetyMode::Normal;
  PoseHealth pose_health = PoseHealth::Lost;
  std::optional<double> fence_room_m;  ///< Geofence::room(); nullopt: there is no fence
  double battery_v = 0.0;
  bool storage_ok = true;
  std::vector<std::string> missing_edges;  ///< of the transform tree, "flange -> lidar"
  int tree_edges = 0;                      ///< of the full tree
  std::vector<ClockReading> clocks;
  bool has_pumps = true;
  std::optional<PumpsState> pumps;
  DeviceSet lacking;                   ///< of what the mission needs
  std::vector<LimitRow> limits;        ///< configured against possible
  std::string reported_beyond_limit;   ///< by a device; empty: nothing
  bool map_in_use = true;              ///< false: odometry alone, by configuration
  std::optional<MapFit> map_fit;       ///< nullopt: no scan matched since the robot was put down
  std::string match_failure;           ///< why the newest scan did not match; may be empty
  std::optional<double> disk_free_gb;  ///< nullopt: cannot be told
  double recording_needs_gb = 0.0;     ///< recording.min_free_gb
};

struct PreflightLimits {
  double device_age_s = 0.2;
  double lidar_age_s = 0.5;
  double lidar_missing = 0.01;    ///< of its packets; more: warn
  double product_age_s = 1.0;     ///< of a cloud while the LiDAR delivers
  double battery_min_v = 25.6;    ///< 3.2 V a cell
  double clock_error_s = 0.02;    ///< console.md section 3, row 15
  double pump_idle_a = 0.5;       ///< a pump at rest draws less
  double map_inliers = 0.4;       ///< of the scan's surfaces, explained by the map; less: fail
  double map_inliers_good = 0.5;  ///< less: warn
  double map_rms_m = 0.05;        ///< of those, more: warn
  double disk_min_gb = 0.2;       ///< checkpoints and logs of a mission; less: fail
  void visit(ConfigArchive& a);
};

/// One row a check: what was found, and what to do when it fails or warns. All must hold, and those
/// of the mission (Mission::checks), before a mission starts. The pumps' row looks at the current
/// at rest: that a pump moves water shows only when it sprays.
[[nodiscard]] std::vector<Check> preflight(const PreflightInputs& inputs,
                                           const PreflightLimits& limits);
/// Whose setpoints the actuators follow, by name: "base: teleop, arm: nobody". Always well: that
/// there is never more than one is checked where they are written (robot/control/setpoint_slot.h).
struct ActuatorWriter {
  std::string actuator;
  std::optional<Writer> writer;
};
[[nodiscard]] Check writersCheck(const std::vector<ActuatorWriter>& actuators, Mode mode);
[[nodiscard]] bool allOk(const std::vector<Check>& checks);
/// What perception owes: frames arrive and nothing is made of them ("no cloud for 3.1 s although
/// the LiDAR delivers"). Empty: it keeps up, or its sensors are silent, which is their own row.
[[nodiscard]] std::string lateProduct(const PreflightInputs& inputs, const PreflightLimits& limits);
/// "no scan for 2.1 s" of a LiDAR that has delivered; empty: it delivers, or never has.
[[nodiscard]] std::string silentLidar(const PreflightInputs& inputs, const PreflightLimits& limits);
/// Which of arm, base and pumps is silent and for how long ("no state of the base for 1.2 s"):
/// whatever the mission is at, it stands still. Empty: all report.
[[nodiscard]] std::string silentDevice(const PreflightInputs& inputs,
                                       const PreflightLimits& limits);
/// "LiDAR: no data for 2.1 s; check its cable and power" or empty.
[[nodiscard]] std::string firstFailure(const std::vector<Check>& checks);

}  // namespace kiln
