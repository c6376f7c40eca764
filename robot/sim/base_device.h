#pragma once

#include "common/core/stamp.h"
#include "common/model/sensor.h"
#include "robot/hal/drive_base.h"
#include "robot/sim/physics.h"
#include "robot/sim/random.h"

namespace kiln::sim {

/// Motor controllers of the four steered hub wheels. They know the nominal wheels only: a wheel's
/// radius error acts between shaft and ground, its steering offset between encoder and wheel. The
/// battery that all draw from is theirs: its charge falls with the current, its voltage with both;
/// empty, nothing moves any more. Thread-compatible.
class BaseDevice {
 public:
  BaseDevice(const BaseDeviceConfig& config, const RobotGeometry& robot, const TrueRobot& truth,
             std::uint64_t seed);

  /// @return empty, or why the command was refused (then the watchdog keeps counting).
  std::string write(Stamp now, const WheelCommands& command);
  void reset();
  /// A motor controller gone wrong: it drives factor x commanded + offset. 1, 0: healthy.
  void setRunaway(double factor, double offset_mps) { runaway_ = {factor, offset_mps}; }
  void control(Stamp now, double step_s, Physics& physics);
  [[nodiscard]] BaseState report(Stamp now, const Physics& physics);
  [[nodiscard]] bool batteryEmpty() const { return charge_ <= 0.0; }
  [[nodiscard]] bool stoppedByWatchdog() const { return watchdog_stop_; }

 private:
  void followCommand(Stamp now, double step_s);
  void driveTowards(const std::array<double, 4>& wanted, double step_s);

  BaseDeviceConfig config_;
  RobotGeometry robot_;
  TrueRobot truth_;
  WheelCommands command_{};
  std::array<double, 4> steer_ref_{}, drive_ref_{}, integral_{}, drive_torque_nm_{};
  std::array<double, 2> runaway_{1.0, 0.0};
  Random noise_;
  double power_w_ = 0.0;
  double charge_, current_a_ = 0.0;  ///< share of a full battery; drawn from it
  Stamp command_time_;
  bool commanded_ = false;
  bool watchdog_stop_ = true;
};

}  // namespace kiln::sim
