#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>

#include "common/config/config_archive.h"
#include "common/core/clock.h"
#include "common/robot_model/robot_geometry.h"
#include "robot/control/writer.h"
#include "robot/hal/drive_base.h"
#include "robot/safety/geofence.h"
#include "robot/safety/stop_latch.h"

namespace kiln {

/// Wanted velocity of the base; older than `ttl` means ramp to zero (begins within 250 ms of the
/// last one, at 2 m/s^2).
struct BaseSetpoint {
  Stamp stamp;
  Duration ttl = std::chrono::milliseconds(250);
  Twist2 twist;  ///< base frame
  Writer writer = Writer::Program;
  [[nodiscard]] bool rests() const {
    return twist.vx_mps == 0.0 && twist.vy_mps == 0.0 && twist.wz_radps == 0.0;
  }
};

struct BaseTracking {
  Stamp stamp;
  bool ready = false;
  Twist2 commanded;       ///< after limits
  Twist2 measured;        ///< from the wheels
  Pose2 X_odom_base;      ///< wheel odometry since the last reset
  double slip_mps = 0.0;  ///< rms disagreement of the wheels with one rigid motion
  double trim_mps = 0.0;  ///< added to the commanded speed against slope and weak drives
  std::array<double, 4> drive_current_a{};  ///< measured, order as in BaseState
  bool aligning = false;                    ///< waits for the wheels to point the right way
  bool stop_latched = false;
  bool at_rest = true;
  std::string blocked;
  std::string limited;  ///< what the geofence took away from the command, and why
  std::optional<Writer>
      writer;  ///< of the setpoint that is followed; nullopt: none asks for motion
};

/// Four steered wheels: inverse kinematics with steering range and rate limits (waits for the
/// wheels to point the right way before driving), velocity, acceleration and jerk limits, odometry
/// from the measured wheels. Integral action on the measured speed carries the robot up a slope at
/// the commanded speed and keeps it from rolling back at rest, also with drives whose own loop
/// gives way under load; there is no power limit. A base that moves on after STOP gets no setpoints
/// until STOP is cleared: the device's own watchdog brakes it. setpoint()/tracking() thread-safe;
/// tick() confined to the control thread.
class BaseController {
 public:
  struct Config {
    double max_speed_mps = 1.0;
    double max_yaw_rate_radps = 0.8;
    double max_accel_mps2 = 0.8;
    double stop_decel_mps2 = 1.8;  ///< the drives brake with 2.0: they can follow it
    double max_jerk_mps3 = 4.0;
    double stop_jerk_mps3 = 20.0;  ///< ramp-in of the stop: 1.8 m/s^2 after 0.09 s
    double max_setpoint_age_s =
        0.22;  ///< stop begins at the smaller of this and the setpoint's ttl
    double max_state_age_s = 0.1;
    double future_tolerance_s = 0.05;    ///< setpoints stamped further ahead are refused
    double min_wheel_speed_mps = 0.004;  ///< slower wheels keep their angle
    double align_wait_deg = 30.0;        ///< a wheel further off than this: stop and turn it first
    double align_done_deg = 4.0;
    double speed_integral_hz = 3.0;  ///< measured speed that stays behind is made good; 0: not
    double max_trim_mps = 0.05;      ///< by no more than this: twice what 4 degrees need, and too
                                     ///< little to hide a runaway
    void visit(ConfigArchive& a);
  };
  BaseController(Config config, const RobotGeometry& robot, DriveBase& base, const StopLatch& stop);
  ~BaseController();
  void setpoint(const BaseSetpoint& setpoint);
  /// From then on no command leads the footprint out of the fence, whoever gives it. Before the
  /// first placeInMap() nothing is limited: where the robot stands is not known.
  void setGeofence(std::shared_ptr<const Geofence> fence);
  /// X_map_odom of localisation, at each correction; nullopt: not known (lost).
  void placeInMap(const std::optional<Pose2>& X_map_odom);
  void resetOdometry();
  void tick(Stamp now);
  [[nodiscard]] BaseTracking tracking() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace kiln
