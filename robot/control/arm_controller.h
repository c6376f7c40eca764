#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/config/config_archive.h"
#include "common/core/clock.h"
#include "common/robot_model/robot_geometry.h"
#include "robot/control/writer.h"
#include "robot/hal/arm.h"
#include "robot/safety/stop_latch.h"

namespace kiln {

/// What the mission (50 Hz) or the teleoperator wants of the arm. Older than `ttl` means stop.
struct ArmSetpoint {
  enum class Kind { Hold, Joints, JointVelocity };
  Kind kind = Kind::Hold;
  Stamp stamp;
  Duration ttl = std::chrono::milliseconds(250);
  Vector6d q =
      Vector6d::Zero();  ///< Joints: target for this instant on a jerk-limited trajectory, rad
  Vector6d qd = Vector6d::Zero();  ///< Joints: feed-forward; JointVelocity: the wish, rad/s
  double stop_force_n = 0.0;  ///< > 0: guarded motion, stop and latch a contact above this force
  Writer writer = Writer::Program;
  [[nodiscard]] bool rests() const {
    return kind == Kind::Hold || (kind == Kind::JointVelocity && qd.isZero(0.0));
  }
};

struct ArmTracking {
  Stamp stamp;
  bool ready = false;  ///< state is fresh and the arm may move
  Vector6d q_command = Vector6d::Zero();
  double tracking_error_rad = 0.0;
  bool contact_stop = false;  ///< latched until the next Hold setpoint
  double contact_force_n = 0.0;
  bool stop_latched = false;
  bool at_rest = true;
  bool protective_stop = false;  ///< latched until releaseProtectiveStop()
  bool refused =
      false;  ///< the newest setpoint was refused (NaN, out of limits, jump); `blocked` says why
  /// Times that the force sensor was zeroed and the force has settled since.
  std::uint32_t zeroings = 0;
  std::string
      blocked;  ///< why it does not move: "protective stop", "STOP latched", "setpoint too old" ...
  std::optional<Writer> writer;  ///< as of BaseTracking
};

/// Tracks setpoints at the servo rate with velocity, acceleration and jerk limits. Refuses NaN,
/// out-of-limit and stale setpoints; never lets one reach the device. A protective stop of the
/// device is latched here: only releaseProtectiveStop() ends it, and then nothing moves until a
/// fresh setpoint comes. A device that is met anew is told its payload, and its force sensor is
/// zeroed once the arm rests without contact. setpoint(), tracking(), releaseProtectiveStop(), carry() and
/// zeroForce() are thread-safe, tick() is confined to the control thread.
class ArmController {
 public:
  struct Config {
    double servo_rate_hz = 125.0;  ///< 500 for a UR10e
    double max_speed_scale = 0.5;  ///< of the vendor's joint speed limits
    double max_accel_radps2 = 4.0;
    double max_jerk_radps3 = 40.0;
    double stop_decel_radps2 = 8.0;
    double stop_jerk_radps3 = 160.0;  ///< ramp-in of the stop: full deceleration after 50 ms
    double tracking_gain_hz = 5.0;    ///< 1/s, joint error to correcting speed
    double max_lead_s =
        0.2;  ///< a target that the speed limit does not reach within this is a jump: refused
    double limit_margin_deg = 2.0;  ///< soft limits inside the vendor's joint range
    double max_tracking_error_deg =
        12.0;  ///< measured against commanded; more stops and latches until Hold
    double max_state_age_s = 0.1;
    double future_tolerance_s = 0.05;  ///< setpoints stamped further ahead are refused
    double force_filter_s = 0.02;      ///< low-pass against 1 N rms noise of the sensor
    double force_bias_filter_s = 1.0;  ///< slow mean of the force at rest, subtracted
    double max_force_bias_n = 10.0;    ///< a real contact must not be learnt away
    double payload_kg = 5.0;           ///< head with sensors, as it was weighed
    std::vector<double> payload_com_m{0.0, 0.0, 0.09};  ///< its centre of mass in `flange`
    double max_zero_force_n = 25.0;  ///< more at rest is a contact: the force sensor is not zeroed
    void visit(ConfigArchive& a);
  };
  ArmController(Config config, const RobotGeometry& robot, Arm& arm, const StopLatch& stop);
  ~ArmController();
  void setpoint(const ArmSetpoint& setpoint);
  void tick(Stamp now);
  [[nodiscard]] ArmTracking tracking() const;
  /// Ends a latched protective stop, at the device and here. Only on the operator's explicit word.
  /// Afterwards the command is the measured pose and every earlier setpoint is void.
  Result<void> releaseProtectiveStop();
  /// What hangs on the flange beyond the head from now on; mass 0: nothing. The device is told of
  /// both as one, also when it comes back after it was away. Thread-safe. @pre finite, mass >= 0.
  void carry(const ArmPayload& load);
  /// Zeroes the force sensor as soon as the arm rests without contact: tracking().zeroings counts
  /// it. Thread-safe.
  void zeroForce();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace kiln
