#include "robot/control/arm_controller.h"

#include <atomic>
#include <cmath>
#include <mutex>

#include <fmt/format.h>

#include "common/core/check.h"
#include "common/core/mutex.h"
#include "common/core/units.h"
#include "robot/control/arm_setpoint_check.h"
#include "robot/control/contact_monitor.h"
#include "robot/control/joint_tracker.h"
#include "robot/control/setpoint_slot.h"

namespace kiln {
namespace {

constexpr double kMaxTick = 0.05;  // s; a longer gap is a slipped tick, not a longer step
constexpr double kExtrapolate =
    0.06;  // s; three periods of 50 Hz setpoints, then the reference stands
constexpr double kRestSpeed = 0.02;      // rad/s, measured
constexpr double kCommandRest = 1e-4;    // rad/s
constexpr double kForceSettles_s = 0.2;  // payload told or zeroed: until the force shows it
constexpr double kDeviceAway_s = 1.0;
constexpr auto kMaxTtl = std::chrono::milliseconds(250);
// After this long without a target the device has stopped by its own watchdog (200 ms) or is about
// to.
constexpr auto kDeviceHolds = std::chrono::milliseconds(150);
constexpr auto kDeviceRests = std::chrono::milliseconds(300);

}  // namespace

struct ArmController::Impl {
  using Kind = ArmSetpoint::Kind;

  Impl(Config c, const RobotGeometry& robot, Arm& device, const StopLatch& stop_latch)
      : config(c),
        hard_limit(robot.arm.position_limit),
        vendor_speed(robot.arm.velocity_limit),
        arm(device),
        stop(stop_latch),
        contact({c.force_filter_s, c.force_bias_filter_s, c.max_force_bias_n}) {
    limits.position = hard_limit.array() - c.limit_margin_deg * kDeg;
    limits.speed = robot.arm.velocity_limit * c.max_speed_scale;
    limits.max_lead_s = c.max_lead_s;
  }

  /// Everything that forbids motion whatever the setpoint says; empty if nothing does.
  std::string deviceBlock(Stamp now, const std::optional<ArmState>& state) {
    if (!state) return "no arm state yet";
    if (!state->q.allFinite() || !state->qd.allFinite()) return "arm state is not a number";
    switch (state->safety) {
      case ArmSafetyMode::ProtectiveStop:
        protective = true;
        break;
      case ArmSafetyMode::EmergencyStop:
        return "emergency stop at the arm";
      case ArmSafetyMode::Fault:
        return "arm fault";
      case ArmSafetyMode::Normal:
      case ArmSafetyMode::Reduced:
        if (protective && release_requested.exchange(false)) protective = false;
        break;
    }
    if (protective) return "protective stop: it needs the operator's word to be released";
    if (!state->powered) return "arm is not powered";
    const double age = toSeconds(now - state->stamp);
    if (age > config.max_state_age_s) {
      was_stale = true;
      return fmt::format("arm state is {:.0f} ms old", 1e3 * age);
    }
    return "";
  }

  /// A device that was away has been switched off in between, for all that is known.
  void setUpForceSensor(Stamp now, const ArmState& state, double dt) {
    if (zero_requested.exchange(false) && force_sensor != ForceSensor::Unknown) {
      force_sensor = ForceSensor::Told;
      rest_s = 0.0;
    }
    if (load_changed.exchange(false) && force_sensor != ForceSensor::Unknown &&
        !arm.setPayload(payload()))
      load_changed = true;
    if (toSeconds(now - state.stamp) > kDeviceAway_s) {
      force_sensor = ForceSensor::Unknown;
      return;
    }
    rest_s = commandRests() && state.qd.cwiseAbs().maxCoeff() < kRestSpeed ? rest_s + dt : 0.0;
    switch (force_sensor) {
      case ForceSensor::Unknown: {
        if (!arm.setPayload(payload())) return;
        force_sensor = ForceSensor::Told;
        rest_s = 0.0;
        return;
      }
      case ForceSensor::Told:
        if (rest_s < kForceSettles_s ||
            !(state.wrench_tool.head<3>().norm() < config.max_zero_force_n))
          return;
        if (!arm.zeroForceSensor()) return;
        force_sensor = ForceSensor::Zeroed;
        rest_s = 0.0;
        return;
      case ForceSensor::Zeroed:
        if (rest_s < kForceSettles_s) return;
        contact.restart();
        force_sensor = ForceSensor::Ready;
        ++zeroings;
        return;
      case ForceSensor::Ready:
        return;
    }
  }

  /// Head and what it holds.
  [[nodiscard]] ArmPayload payload() const {
    const std::lock_guard lock(mutex);
    const std::vector<double>& com = config.payload_com_m;
    ArmPayload all{config.payload_kg, {com[0], com[1], com[2]}};
    if (load.mass_kg <= 0.0) return all;
    all.mass_kg += load.mass_kg;
    all.p_flange_com += (load.mass_kg / all.mass_kg) * (load.p_flange_com - all.p_flange_com);
    return all;
  }

  [[nodiscard]] bool commandRests() const {
    return tracker.velocity().cwiseAbs().maxCoeff() < kCommandRest;
  }

  /// In these the device holds or falls by itself: the command must follow the joints, not the
  /// other way round.
  bool mustFollowDevice(const ArmState& state) const {
    return protective || !state.powered || state.safety == ArmSafetyMode::EmergencyStop ||
           state.safety == ArmSafetyMode::Fault;
  }

  /// The device has not followed us for a while (first state, lost ticks, a link that was down):
  /// begin anew from where the joints are.
  bool mustBeginAnew(Stamp now) const {
    const bool silent = last_sent && now - *last_sent > kDeviceHolds && !tracking_lost;
    return !synchronised || silent || (was_stale && commandRests());
  }

  /// Joints that do not follow are blocked, or people moved them. Pressing on is no answer: nothing
  /// is sent, so that the device holds, until a Hold setpoint came and the arm rests.
  void watchTrackingError(Stamp now, const ArmState& state) {
    const double error = (tracker.position() - state.q).cwiseAbs().maxCoeff();
    if (!tracking_lost && error > config.max_tracking_error_deg * kDeg) {
      tracking_lost = true;
      hold_seen = false;
      lost_text = fmt::format("arm does not follow: {:.1f} deg behind", error / kDeg);
    }
    if (!tracking_lost) return;
    tracker.reset(state.q);
    const bool rests = state.qd.cwiseAbs().maxCoeff() < kRestSpeed;
    if (hold_seen && rests && last_sent && now - *last_sent > kDeviceRests) tracking_lost = false;
  }

  void followDevice(const ArmState& state) {
    tracker.reset(state.q);
    slot.clear();
    current = {};
    contact_stop = tracking_lost = was_stale = false;
    synchronised = true;
    last_sent.reset();
  }

  /// The setpoint to act on, or why there is none.
  std::string takeSetpoint(Stamp now) {
    const auto taken = slot.take(now, kMaxTtl, fromSeconds(config.future_tolerance_s));
    refused = taken.refused;
    if (!taken.setpoint) {
      current = {};
      has_previous = false;
      return taken.blocked;
    }
    const ArmSetpoint& next = *taken.setpoint;
    if (next.stamp == current.stamp && next.kind == current.kind) return "";
    const std::string why = refusal(next, tracker.position(), limits);
    if (!why.empty()) {
      slot.refuse(why);
      refused = true;
      current = {};
      has_previous = false;
      return why;
    }
    accept(next);
    return "";
  }

  void accept(const ArmSetpoint& next) {
    qdd_reference.setZero();
    const double gap = toSeconds(next.stamp - current.stamp);
    if (has_previous && current.kind == Kind::Joints && next.kind == Kind::Joints && gap > 0.0 &&
        gap < kExtrapolate) {
      const Vector6d slope = (next.qd - current.qd) / gap;
      qdd_reference = slope.cwiseMax(-config.max_accel_radps2).cwiseMin(config.max_accel_radps2);
    }
    current = next;
    has_previous = true;
    if (next.kind == Kind::Hold) {
      contact_stop = false;
      hold_seen = true;
    }
  }

  /// Latched ends of guarded or failing motion.
  std::string motionBlock() {
    if (tracking_lost) return lost_text;
    if (current.stop_force_n > 0.0 && contact.force() > current.stop_force_n) contact_stop = true;
    if (contact_stop) return fmt::format("contact of {:.0f} N", contact.force());
    return "";
  }

  JointTracker::Reference referenceAt(Stamp now) const {
    const double since = std::clamp(toSeconds(now - current.stamp), 0.0, kExtrapolate);
    JointTracker::Reference ref;
    ref.q = current.q + current.qd * since + 0.5 * qdd_reference * since * since;
    ref.q = ref.q.cwiseMax(-limits.position).cwiseMin(limits.position);
    if (since < kExtrapolate) {
      ref.qd = current.qd + qdd_reference * since;
      ref.qdd = qdd_reference;
    }
    return ref;
  }

  /// Jog speed within the limits, slowing down before the end of the joint range.
  Vector6d jogSpeed() const {
    Vector6d qd = current.qd.cwiseMax(-limits.speed).cwiseMin(limits.speed);
    for (int i = 0; i < 6; ++i) {
      const double side = qd[i] < 0 ? -1.0 : 1.0;
      const double room = std::max(0.0, limits.position[i] - side * tracker.position()[i]);
      const double allowed = std::min(std::sqrt(config.max_accel_radps2 * room), 4.0 * room);
      qd[i] = side * std::min(std::abs(qd[i]), allowed);
    }
    return qd;
  }

  void move(Stamp now, bool blocked, double dt) {
    const MotionLimits usual{config.max_accel_radps2, config.max_jerk_radps3};
    const MotionLimits fast{config.stop_decel_radps2, config.stop_jerk_radps3};
    if (blocked) {
      tracker.stepVelocity(Vector6d::Zero(), fast, dt);
    } else if (current.kind == Kind::Joints) {
      tracker.stepReference(referenceAt(now), config.tracking_gain_hz, limits.speed, usual, dt);
    } else if (current.kind == Kind::JointVelocity) {
      tracker.stepVelocity(jogSpeed(), usual, dt);
    } else {
      tracker.stepVelocity(Vector6d::Zero(), usual, dt);
    }
  }

  /// The last gate before the device: whatever went wrong above, no bad command passes.
  std::string send(Stamp now, const Vector6d& before, double dt) {
    const Vector6d q = tracker.position();
    const Vector6d step = (q - before).cwiseAbs();
    bool good = q.allFinite() && tracker.velocity().allFinite();
    for (int i = 0; good && i < 6; ++i) {
      const bool outwards = std::abs(q[i]) > hard_limit[i] && std::abs(q[i]) > std::abs(before[i]);
      good = step[i] <= vendor_speed[i] * dt + 1e-9 && !outwards;
    }
    if (!good) {
      tracker.reset(before);
      return "command held: it would have left the joint limits";
    }
    last_sent = now;
    const auto sent = arm.servo({q, tracker.velocity()});
    return sent ? "" : sent.error().message;
  }

  void publish(Stamp now, const std::optional<ArmState>& state, const std::string& blocked,
               bool ready) {
    const std::lock_guard lock(mutex);
    tracking.stamp = now;
    tracking.ready = ready;
    tracking.q_command = tracker.position();
    if (state && state->q.allFinite()) {
      tracking.tracking_error_rad = (tracker.position() - state->q).cwiseAbs().maxCoeff();
      tracking.at_rest = commandRests() && state->qd.cwiseAbs().maxCoeff() < kRestSpeed;
    }
    tracking.contact_stop = contact_stop;
    tracking.contact_force_n = contact.force();
    tracking.protective_stop = protective;
    tracking.refused = refused;
    tracking.zeroings = zeroings;
    tracking.stop_latched = stop.latched();
    tracking.blocked = blocked;
    const bool moves = blocked.empty() && !current.rests();
    tracking.writer = moves ? std::optional(current.writer) : std::nullopt;
  }

  Config config;
  Vector6d hard_limit, vendor_speed;
  ArmSetpointLimits limits;
  Arm& arm;
  const StopLatch& stop;
  SetpointSlot<ArmSetpoint> slot;
  JointTracker tracker;
  ContactMonitor contact;
  ArmSetpoint current;
  Vector6d qdd_reference = Vector6d::Zero();
  bool has_previous = false, synchronised = false, was_stale = false;
  bool protective = false, contact_stop = false, tracking_lost = false, refused = false;
  bool hold_seen = false;  ///< since tracking was lost
  std::string lost_text;
  enum class ForceSensor : std::uint8_t { Unknown, Told, Zeroed, Ready };
  ForceSensor force_sensor = ForceSensor::Unknown;
  double rest_s = 0.0;
  std::uint32_t zeroings = 0;
  std::atomic<bool> release_requested{false}, zero_requested{false}, load_changed{false};
  ArmPayload load;  ///< beyond the head, guarded by `mutex`
  std::optional<Stamp> last_tick, last_sent;
  mutable Mutex mutex;
  ArmTracking tracking;
};

ArmController::ArmController(Config config, const RobotGeometry& robot, Arm& arm,
                             const StopLatch& stop)
    : impl_(std::make_unique<Impl>(config, robot, arm, stop)) {}
ArmController::~ArmController() = default;

void ArmController::setpoint(const ArmSetpoint& setpoint) {
  if (!isFinite(setpoint)) {
    impl_->slot.refuse("setpoint is not a number");
    return;
  }
  impl_->slot.put(setpoint);
}

Result<void> ArmController::releaseProtectiveStop() {
  const auto released = impl_->arm.releaseProtectiveStop();
  if (released) impl_->release_requested = true;
  return released;
}

void ArmController::carry(const ArmPayload& load) {
  KILN_CHECK(std::isfinite(load.mass_kg) && load.mass_kg >= 0.0 && load.p_flange_com.allFinite(),
             load.mass_kg);
  {
    const std::lock_guard lock(impl_->mutex);
    impl_->load = load;
  }
  impl_->load_changed = true;
}

void ArmController::zeroForce() { impl_->zero_requested = true; }

void ArmController::tick(Stamp now) {
  Impl& m = *impl_;
  const double dt = m.last_tick ? std::clamp(toSeconds(now - *m.last_tick), 0.0, kMaxTick) : 0.0;
  m.last_tick = now;
  const std::optional<ArmState> state = m.arm.state();
  std::string blocked = m.deviceBlock(now, state);
  const bool usable = state && state->q.allFinite() && state->qd.allFinite();
  const bool follow = usable && m.mustFollowDevice(*state);
  if (follow || (usable && blocked.empty() && m.mustBeginAnew(now))) m.followDevice(*state);
  const bool ready = blocked.empty() && !m.stop.latched();
  if (usable && m.synchronised && blocked.empty()) m.watchTrackingError(now, *state);
  if (usable && state->wrench_tool.allFinite()) {
    m.setUpForceSensor(now, *state, dt);
    m.contact.update(state->wrench_tool.head<3>(), m.commandRests(), dt);
  }
  if (blocked.empty() && m.stop.latched()) {
    m.slot.clear();
    m.current = {};
    blocked = "STOP latched by " + m.stop.source();
  }
  if (blocked.empty()) blocked = m.takeSetpoint(now);
  if (const std::string latched = m.motionBlock(); blocked.empty()) blocked = latched;
  if (m.synchronised && !follow && !m.tracking_lost && dt > 0.0) {
    const Vector6d before = m.tracker.position();
    m.move(now, !blocked.empty(), dt);
    const std::string failed = m.send(now, before, dt);
    if (blocked.empty()) blocked = failed;
  }
  m.publish(now, state, blocked, ready);
}

ArmTracking ArmController::tracking() const {
  const std::lock_guard lock(impl_->mutex);
  return impl_->tracking;
}

}  // namespace kiln
