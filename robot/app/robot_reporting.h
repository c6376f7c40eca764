#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/core/log.h"
#include "robot/app/health_watch.h"
#include "robot/app/operator_desk.h"
#include "robot/app/preflight.h"
#include "robot/app/robot_localization.h"
#include "robot/app/run_recorder.h"
#include "robot/app/sensor_intake.h"
#include "robot/app/telemetry_hub.h"
#include "robot/app/trajectory_log.h"

namespace kiln {

/// What the robot tells of itself: checks, alarms, status, scene, recording. Reads the other parts
/// and changes nothing in them but the alarms. Confined to the mission thread, checkHealth() aside.
class RobotReporting {
 public:
  struct Parts {
    const RobotBody& body;
    SensorIntake& intake;
    const RobotLocalization& localization;
    const RobotMission& mission;
    OperatorDesk& desk;
    OperatorLink* link;  ///< nullptr: nobody listens
  };
  RobotReporting(Parts parts, Executor& executor);

  /// What stays as it is.
  void open();
  /// Another mission, or the same after a restart.
  void announceMission();
  void runChecks(Stamp now);
  void raiseAlarms(Stamp now);
  void publish(Stamp now);
  void record(Stamp now);
  /// On a thread of its own: does the mission thread stand?
  void checkHealth(Stamp now) { health_.tick(now); }

  [[nodiscard]] const std::vector<Check>& checks() const { return checks_; }
  [[nodiscard]] TelemetryHub& telemetry() { return telemetry_; }
  [[nodiscard]] const TelemetryHub& telemetry() const { return telemetry_; }

 private:
  void raiseMissionAlarms(Stamp now);
  [[nodiscard]] RobotStatus status(Stamp now) const;
  [[nodiscard]] Scene scene(Stamp now) const;
  [[nodiscard]] PreflightInputs preflightInputs(Stamp now) const;
  [[nodiscard]] std::vector<std::string> missingTransforms(Stamp now) const;
  [[nodiscard]] std::vector<ClockReading> clockReadings(Stamp now) const;
  /// Free space, looked at every two seconds.
  void checkDisk(Stamp now);

  Parts parts_;
  const RobotBody& body_;
  TelemetryHub telemetry_;
  HealthWatch health_;
  TrajectoryLog driven_;
  bool driven_grew_ = false;
  std::vector<Check> checks_;
  std::string silent_device_;     ///< which does not report; empty: all do
  std::string silent_lidar_;      ///< since when; empty: it delivers
  std::string late_product_;      ///< what perception owes; empty: it keeps up
  std::vector<LimitRow> limits_;  ///< configured against possible
  std::optional<double> disk_free_gb_;
  std::optional<Stamp> disk_seen_;
  std::vector<std::string> mission_alarms_;  ///< ids that the mission has raised
  std::uint64_t status_seq_ = 0;
  std::uint64_t recorded_ticks_ = 0;
  LogSinkHandle log_sink_;  ///< the last member: no line comes in while the others go
};

}  // namespace kiln
