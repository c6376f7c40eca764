#pragma once

// Private to robot*.cpp: what one robot is made of, in the order in which it is built.

#include <atomic>

#include "common/transport/log_throttle.h"
#include "robot/app/health_watch.h"
#include "robot/app/mission_control.h"
#include "robot/app/mission_report.h"
#include "robot/app/robot.h"
#include "robot/app/run_recorder.h"
#include "robot/app/telemetry_hub.h"
#include "robot/app/trajectory_log.h"
#include "robot/safety/authority.h"

namespace kiln {

struct Robot::Impl {
  Impl(const RobotSettings& settings_in, const RobotOptions& options_in, Devices devices_in,
       const Clock& clock_in, Executor& executor, OperatorLink* link_in, StopLatch& stop_in,
       RobotGeometry robot_in, ArenaMap arena_in, const SprayCalibration& spray_in,
       std::vector<Macro> macros_in, Location location);
  /// The mission that `options` names, lent what it works with.
  [[nodiscard]] Result<void> makeMission(Executor& executor);
  void start(Executor& executor);
  void controlTick(Stamp now);
  void missionTick(Stamp now);

  void readSensors(Stamp now);
  void takePerception(Stamp now);
  void watchPosition(Stamp now);
  void placeScan(PerceptionJobs::ScanResult& result);
  void watchMotion(Stamp now);
  void obeyOperators(Stamp now);
  void runChecks(Stamp now);
  [[nodiscard]] GateSituation gateSituation(Stamp now) const;
  void beginReport();
  void updateReport();
  /// Goes on from the checkpoint; moves and starts nothing.
  Result<void> resume();
  void raiseAlarms(Stamp now);
  void raiseMissionAlarms(Stamp now);
  void publish(Stamp now);
  void record(Stamp now);
  void runCameraOnDemand();
  [[nodiscard]] RobotStatus status(Stamp now) const;
  [[nodiscard]] Scene scene(Stamp now) const;
  [[nodiscard]] LocalizationStatus localizationStatus() const;
  [[nodiscard]] PreflightInputs preflightInputs(Stamp now) const;
  [[nodiscard]] std::vector<std::string> missingTransforms(Stamp now) const;
  [[nodiscard]] std::vector<ClockReading> clockReadings(Stamp now) const;
  /// Free space, looked at every two seconds.
  void lookAtDisk(Stamp now);
  /// What the map makes of a scan, for the preflight; forgotten when the robot is put elsewhere.
  void noteMatch(const Result<ScanMatch>& match, bool believed);
  void forgetMatch();
  [[nodiscard]] StopStatus stopStatus(Stamp now) const;
  [[nodiscard]] Pose2 pose() const { return tracked.X_map_base; }
  /// Why nobody knows where the robot is, in words; empty: it is known.
  [[nodiscard]] std::string positionLost() const;
  [[nodiscard]] std::string checkpointPath() const {
    return options.state_dir.empty() ? std::string()
                                     : options.state_dir + "/" + options.mission + ".checkpoint";
  }
  [[nodiscard]] std::optional<Eigen::Isometry3d> flange() const {
    const auto state = devices.arm.state();
    return state ? std::optional(robot.X_base_flange(state->q)) : std::nullopt;
  }
  /// Where the flange was in map at a stamp of the last seconds.
  [[nodiscard]] std::optional<Eigen::Isometry3d> flangeAt(Stamp stamp) const;

  RobotSettings settings;
  RobotOptions options;
  Devices devices;
  const Clock& clock;
  OperatorLink* link;
  StopLatch& stop;
  RobotGeometry robot;
  ArenaMap arena;
  std::shared_ptr<const Geofence> fence;

  BaseController base;
  ArmController arm;
  PumpController pumps;
  StateHistory history;
  SelfFilter self_filter;
  std::unique_ptr<ScanLocator> locator;
  std::shared_ptr<const MapLayer> map_layer;
  Localizer localizer;
  TrackedPose tracked;
  PerceptionJobs perception;
  LiveSurroundings surroundings;
  MotionWatch motion_watch;
  DriveTo drive;
  MoveArm move_arm;
  SprayCalibration spray;
  RobotBelief belief;
  MacroRunner macros;
  Teleop teleop;
  AlarmBook alarms;
  Authority authority;
  std::unique_ptr<Mission> mission;  ///< made by makeMission(), and the two below with it
  std::unique_ptr<MissionHost> host;
  std::unique_ptr<MissionControl> control;
  TelemetryHub telemetry;
  HealthWatch health;
  MissionReport report;
  TrajectoryLog driven;
  bool driven_grew = false;
  LogSinkHandle log_sink;

  std::vector<Check> checks;
  std::string late_product;      ///< what perception owes; empty: it keeps up
  std::vector<LimitRow> limits;  ///< configured against possible
  std::optional<MapFit> map_fit;
  std::string match_failure;
  std::optional<double> disk_free_gb;
  std::optional<Stamp> disk_seen;
  std::vector<std::string> mission_alarms;  ///< ids that the mission has raised
  std::uint64_t status_seq = 0;
  std::vector<float> locate_s;  ///< wall time of each scan matched, for the timing report
  std::uint64_t recorded_ticks = 0;
  int starts_seen = 0;
  std::optional<Stamp> carried;  ///< the last reset, until the first scan has been matched
  LogThrottle operators_log{"operators", 8.0};  ///< anybody may take and give back all day
  bool camera_runs = false;
  std::atomic<bool> ended{false}, succeeded{false};
};

[[nodiscard]] inline std::optional<Vector6d> joints(const std::optional<ArmState>& arm) {
  return arm ? std::optional(arm->q) : std::nullopt;
}

/// Seconds since `stamp`; nullopt if it never was.
[[nodiscard]] inline std::optional<double> ageOf(const std::optional<Stamp>& stamp, Stamp now) {
  return stamp ? std::optional(toSeconds(now - *stamp)) : std::nullopt;
}

/// A device that does not start is a line in the log and a failing preflight check, not an end.
void warnIfFailed(const Result<void>& started);

}  // namespace kiln
