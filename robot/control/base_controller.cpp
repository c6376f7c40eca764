#include "robot/control/base_controller.h"

#include <atomic>
#include <cmath>
#include <mutex>

#include <fmt/format.h>

#include "common/core/mutex.h"
#include "common/core/units.h"
#include "robot/control/jerk_limiter.h"
#include "robot/control/setpoint_slot.h"
#include "robot/control/swerve_kinematics.h"
#include "robot/control/wheel_odometry.h"

namespace kiln {
namespace {

constexpr double kMaxTick = 0.05;       // s; a longer gap is a slipped tick, not a longer step
constexpr double kMovingSpeed = 0.02;   // m/s; slower, the target decides where the wheels point
constexpr double kRestSpeed = 0.01;     // m/s, measured
constexpr double kSteadyAccel = 0.05;   // m/s^2; faster changes are the drives' own affair ...
constexpr double kSteadyTime = 0.3;     // s; ... and so is settling after them
constexpr double kDisobeySpeed = 0.10;  // m/s, measured after the ramp to zero ...
constexpr double kDisobeyTime = 0.15;   // s; ... for so long: the drives do not obey

bool isFinite(const Twist2& t) {
  return std::isfinite(t.vx_mps) && std::isfinite(t.vy_mps) && std::isfinite(t.wz_radps);
}

}  // namespace

void BaseController::Config::visit(ConfigArchive& a) {
  a.field("max_speed_mps", max_speed_mps, "m/s", 0.05, 4.0, "speed over ground");
  a.field("max_yaw_rate_radps", max_yaw_rate_radps, "rad/s", 0.05, 3.0, "turning speed");
  a.field("max_accel_mps2", max_accel_mps2, "m/s^2", 0.1, 3.0, "speeding up and planned braking");
  a.field("stop_decel_mps2", stop_decel_mps2, "m/s^2", 1.8, 6.0, "ramp to zero on STOP or loss");
  a.field("max_jerk_mps3", max_jerk_mps3, "m/s^3", 0.5, 50, "change of acceleration");
  a.field("stop_jerk_mps3", stop_jerk_mps3, "m/s^3", 10, 200, "change of acceleration on STOP");
  a.field("max_setpoint_age_s", max_setpoint_age_s, "s", 0.05, 0.24, "older setpoints mean stop");
  a.field("max_state_age_s", max_state_age_s, "s", 0.02, 0.5, "older wheel states mean stop");
  a.field("future_tolerance_s", future_tolerance_s, "s", 0, 0.5, "setpoints further ahead refused");
  a.field("min_wheel_speed_mps", min_wheel_speed_mps, "m/s", 0.0005, 0.05,
          "slower wheels keep their angle");
  a.field("align_wait_deg", align_wait_deg, "deg", 5, 80, "stop and turn wheels further off");
  a.field("align_done_deg", align_done_deg, "deg", 0.5, 30, "turned far enough to drive");
  a.field("speed_integral_hz", speed_integral_hz, "1/s", 0, 10,
          "integral action on the measured speed; 0: none");
  a.field("max_trim_mps", max_trim_mps, "m/s", 0, 0.5, "limit of that correction");
}

struct BaseController::Impl {
  Impl(Config c, const RobotGeometry& robot, DriveBase& drive_base, const StopLatch& stop_latch)
      : config(c), kinematics(robot), base(drive_base), stop(stop_latch) {}

  struct Wish {
    Eigen::Vector3d target = Eigen::Vector3d::Zero();
    std::string blocked, limited;
    std::optional<Writer> writer;
  };

  Eigen::Vector3d weighted(const Twist2& t) const {
    return {t.vx_mps, t.vy_mps, t.wz_radps * kinematics.leverArm()};
  }
  Twist2 twistOf(const Eigen::Vector3d& v) const {
    return {v[0], v[1], v[2] / kinematics.leverArm()};
  }

  /// Scaled as a whole, so that the curvature stays the wished one.
  Eigen::Vector3d limited(const Twist2& wish) const {
    const double speed = std::hypot(wish.vx_mps, wish.vy_mps);
    double scale = 1.0;
    if (speed > config.max_speed_mps) scale = config.max_speed_mps / speed;
    const double yaw_rate = std::abs(wish.wz_radps);
    if (yaw_rate > config.max_yaw_rate_radps) {
      scale = std::min(scale, config.max_yaw_rate_radps / yaw_rate);
    }
    return scale * weighted(wish);
  }

  Wish wish(Stamp now, const std::optional<BaseState>& state) {
    if (stop.latched()) {
      slot.clear();
      return {Eigen::Vector3d::Zero(), "STOP latched by " + stop.source(), "", {}};
    }
    if (!state) return {Eigen::Vector3d::Zero(), "no wheel state yet", "", {}};
    const double age = toSeconds(now - state->stamp);
    if (age > config.max_state_age_s) {
      return {
          Eigen::Vector3d::Zero(), fmt::format("wheel state is {:.0f} ms old", 1e3 * age), "", {}};
    }
    if (!kiln::isFinite(*state))
      return {Eigen::Vector3d::Zero(), "wheel state is not a number", "", {}};
    const auto taken = slot.take(now, fromSeconds(config.max_setpoint_age_s),
                                 fromSeconds(config.future_tolerance_s));
    if (!taken.setpoint) return {Eigen::Vector3d::Zero(), taken.blocked, "", {}};
    const Geofence::Limited allowed = insideFence(taken.setpoint->twist);
    return {limited(allowed.twist), "", allowed.reason, taken.writer()};
  }

  Geofence::Limited insideFence(const Twist2& twist) const {
    const std::lock_guard lock(mutex);
    if (!fence || !X_map_odom) return {twist, false, ""};
    // A command above the speed limits would seem to need more room than it will.
    return fence->limit(twistOf(limited(twist)), *X_map_odom * odometry.pose());
  }

  /// Where the wheels shall point for the motion at hand; at rest for the motion that is wished.
  WheelCommands steer(const Eigen::Vector3d& target) const {
    const bool moving = limiter.velocity().norm() > kMovingSpeed;
    const Eigen::Vector3d& motion = moving ? limiter.velocity() : target;
    return kinematics.inverse(twistOf(motion), steer_command, config.min_wheel_speed_mps);
  }

  void updateAligning(const WheelCommands& wanted) {
    double worst = 0.0;
    for (std::size_t i = 0; i < 4; ++i) {
      worst = std::max(worst, std::abs(wanted[i].steer_rad - measured_steer[i]));
    }
    aligning = worst > (aligning ? config.align_done_deg : config.align_wait_deg) * kDeg;
  }

  void turnWheels(const WheelCommands& wanted, double dt) {
    const double max_step = kinematics.steerRate() * dt;
    for (std::size_t i = 0; i < 4; ++i) {
      steer_command[i] += std::clamp(wanted[i].steer_rad - steer_command[i], -max_step, max_step);
    }
  }

  /// Slope: what the drives leave of the commanded speed, summed up while it is steady. At rest the
  /// sum is the way rolled back, so that it holds the place. Blind it gives nothing.
  void updateTrim(bool fresh, double dt) {
    if (!fresh) trim.setZero();
    const bool steady = fresh && !aligning && limiter.acceleration().norm() < kSteadyAccel;
    steady_s = steady ? steady_s + dt : 0.0;
    if (steady_s < kSteadyTime) return;
    const Eigen::Vector2d missing = limiter.velocity().head<2>() -
                                    Eigen::Vector2d(measured.twist.vx_mps, measured.twist.vy_mps);
    trim += config.speed_integral_hz * dt * missing;
    const double size = trim.norm();
    if (size > config.max_trim_mps) trim *= config.max_trim_mps / size;
  }

  /// After STOP a base that moves on though zero is commanded gets no setpoints any more: its own
  /// watchdog then brakes it, which a drive that runs away cannot undo.
  void updateSilence(double dt) {
    const bool moves_on = stop.latched() && limiter.velocity().isZero(1e-6) &&
                          weighted(measured.twist).norm() > kDisobeySpeed;
    disobeyed_s = moves_on ? disobeyed_s + dt : 0.0;
    silent = stop.latched() && (silent || disobeyed_s > kDisobeyTime);
  }

  /// Each wheel drives what its present direction can give of the rigid motion: the cosine of its
  /// error, and reversed when it points the other way.
  WheelCommands drive() const {
    WheelCommands out;
    for (std::size_t i = 0; i < 4; ++i) {
      const Eigen::Vector2d v = kinematics.wheelVelocity(i, twistOf(limiter.velocity())) + trim;
      const double angle = measured_steer[i];
      out[i].steer_rad = steer_command[i];
      out[i].drive_radps =
          (v.x() * std::cos(angle) + v.y() * std::sin(angle)) / kinematics.wheelRadius();
    }
    return out;
  }

  void acceptState(const std::optional<BaseState>& state) {
    if (!state || !kiln::isFinite(*state)) return;
    if (reset_odometry.exchange(false)) odometry.reset();
    odometry.update(kinematics, *state);
    for (std::size_t i = 0; i < 4; ++i) {
      measured_steer[i] = state->wheels[i].steer_rad;
      current[i] = state->wheels[i].drive_current_a;
    }
    measured = kinematics.forward(state->wheels);
    if (!seen_state) takeOver();
    seen_state = true;
  }

  /// The base may still roll, as a program that was killed had driven it: its ramp to rest begins at
  /// the speed that it has, and nobody takes that for disobedience.
  void takeOver() {
    steer_command = measured_steer;
    if (weighted(measured.twist).norm() > kMovingSpeed) limiter.reset(limited(measured.twist));
  }

  void publish(Stamp now, const Wish& w, bool fresh) {
    const std::lock_guard lock(mutex);
    tracking.stamp = now;
    tracking.ready = fresh && !stop.latched();
    tracking.commanded = twistOf(limiter.velocity());
    tracking.measured = measured.twist;
    tracking.slip_mps = measured.residual_mps;
    tracking.trim_mps = trim.norm();
    tracking.drive_current_a = current;
    tracking.X_odom_base = odometry.pose();
    tracking.aligning = aligning;
    tracking.at_rest =
        fresh && limiter.velocity().isZero(1e-6) && weighted(measured.twist).norm() < kRestSpeed;
    tracking.stop_latched = stop.latched();
    tracking.blocked = w.blocked;
    tracking.limited = w.limited;
    tracking.writer = w.writer;
  }

  Config config;
  SwerveKinematics kinematics;
  DriveBase& base;
  const StopLatch& stop;
  SetpointSlot<BaseSetpoint> slot;
  JerkLimiter<3> limiter;
  WheelOdometry odometry;
  std::array<double, 4> steer_command{}, measured_steer{}, current{};
  Eigen::Vector2d trim = Eigen::Vector2d::Zero();  ///< base frame
  double steady_s = 0.0;
  SwerveTwist measured;
  double disobeyed_s = 0.0;
  bool aligning = false, seen_state = false, silent = false;
  std::optional<Stamp> last_tick;
  std::atomic<bool> reset_odometry{false};
  mutable Mutex mutex;
  BaseTracking tracking;
  std::shared_ptr<const Geofence> fence;
  std::optional<Pose2> X_map_odom;
};

BaseController::BaseController(Config config, const RobotGeometry& robot, DriveBase& base,
                               const StopLatch& stop)
    : impl_(std::make_unique<Impl>(config, robot, base, stop)) {}
BaseController::~BaseController() = default;

void BaseController::setpoint(const BaseSetpoint& setpoint) {
  if (!isFinite(setpoint.twist)) {
    impl_->slot.refuse("setpoint is not a number");
    return;
  }
  impl_->slot.put(setpoint);
}

void BaseController::setGeofence(std::shared_ptr<const Geofence> fence) {
  const std::lock_guard lock(impl_->mutex);
  impl_->fence = std::move(fence);
}

void BaseController::placeInMap(const std::optional<Pose2>& X_map_odom) {
  const std::lock_guard lock(impl_->mutex);
  impl_->X_map_odom = X_map_odom;
}

void BaseController::resetOdometry() {
  impl_->reset_odometry = true;
  const std::lock_guard lock(impl_->mutex);
  impl_->X_map_odom.reset();
  impl_->tracking.X_odom_base = {};
}

void BaseController::tick(Stamp now) {
  Impl& m = *impl_;
  const double dt = m.last_tick ? std::clamp(toSeconds(now - *m.last_tick), 0.0, kMaxTick) : 0.0;
  m.last_tick = now;
  const std::optional<BaseState> state = m.base.state();
  m.acceptState(state);
  Impl::Wish wish = m.wish(now, state);
  const bool blocked = !wish.blocked.empty();
  const WheelCommands wanted = m.steer(wish.target);
  m.updateAligning(wanted);
  const bool fresh = state && toSeconds(now - state->stamp) <= m.config.max_state_age_s;
  if (dt > 0.0) {
    m.turnWheels(wanted, dt);
    const MotionLimits limits =
        blocked ? MotionLimits{m.config.stop_decel_mps2, m.config.stop_jerk_mps3}
                : MotionLimits{m.config.max_accel_mps2, m.config.max_jerk_mps3};
    m.limiter.step(m.aligning ? Eigen::Vector3d::Zero() : wish.target, limits, dt);
    m.updateTrim(fresh, dt);
    m.updateSilence(dt);
  }
  if (m.silent) {
    wish.blocked += "; the base moved on, so its setpoints are withheld";
  } else if (m.seen_state) {
    const auto written = m.base.write(m.drive());
    if (!written && wish.blocked.empty()) wish.blocked = written.error().message;
  }
  m.publish(now, wish, fresh);
}

BaseTracking BaseController::tracking() const {
  const std::lock_guard lock(impl_->mutex);
  return impl_->tracking;
}

}  // namespace kiln
