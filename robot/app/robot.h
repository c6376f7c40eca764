#pragma once

#include <memory>
#include <optional>
#include <string>

#include "common/core/clock.h"
#include "common/core/executor.h"
#include "robot/app/devices.h"
#include "robot/app/operator_link.h"
#include "robot/app/robot_settings.h"

namespace kiln {

class RunRecorder;

/// How this run of the daemon is meant; from the command line.
struct RobotOptions {
  std::string mission = missionNames().front();
  std::string mission_uuid;
  bool start = false;     ///< start the mission by itself as soon as the preflight checks pass
  bool resume = false;    ///< go on from the checkpoint in state_dir
  bool lockstep = false;  ///< figures that depend on wall time stay out of reports
  std::string state_dir;  ///< checkpoint and pose; empty = keep nothing
  std::string
      calibration;  ///< file of kiln-eval calibrate; empty: state_dir/calibration.yaml if any
  std::string version;
  Environment environment = Environment::Sim;
  std::optional<Pose2> start_pose;  ///< where the robot stands; nullopt: where the arena says
  RunRecorder* recorder = nullptr;  ///< nullptr: this robot cannot record; outlives the robot
};

/// The composition root: builds every part of one robot and registers its rate groups with the
/// executor: control at the servo rate, mission at 50 Hz. The mission tick is the only writer of
/// world model and state machine.
class Robot {
 public:
  /// Loads geometry, arena and calibration, restores the checkpoint if asked to. `link` may be null
  /// (no stations). Everything passed in must outlive the robot; the executor must be stopped
  /// before the robot dies.
  [[nodiscard]] static Result<std::unique_ptr<Robot>> create(const RobotSettings& settings,
                                                             const RobotOptions& options,
                                                             Devices devices, const Clock& clock,
                                                             Executor& executor, OperatorLink* link,
                                                             StopLatch& stop);
  ~Robot();
  Robot(const Robot&) = delete;
  Robot& operator=(const Robot&) = delete;

  /// The mission has ended (or none could be started, see failure()). Thread-safe.
  [[nodiscard]] bool missionEnded() const;
  [[nodiscard]] bool missionSucceeded() const;
  /// The mission's report as JSON. Call when no tick runs any more.
  [[nodiscard]] std::string reportJson(Stamp now) const;

  /// Wall time of each scan that was located, seconds. Call when no tick runs any more.
  [[nodiscard]] const std::vector<float>& locateCosts() const;

  [[nodiscard]] const BaseController& base() const;
  [[nodiscard]] const PumpController& pumps() const;

 private:
  struct Impl;
  explicit Robot(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace kiln
