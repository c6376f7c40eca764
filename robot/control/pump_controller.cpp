#include "robot/control/pump_controller.h"

#include <cmath>
#include <mutex>

#include <fmt/format.h>

#include "common/core/mutex.h"
#include "robot/control/pump_model.h"
#include "robot/control/setpoint_slot.h"

namespace kiln {
namespace {
constexpr double kMaxTick = 0.2;      // s; a longer gap does not count as spraying time
constexpr double kCheckedDuty = 0.2;  // below it a healthy pump may draw too little to tell
constexpr std::array<const char*, 2> kSide = {"left", "right"};
}  // namespace

void PumpController::Config::visit(ConfigArchive& a) {
  a.field("flow_lpm", flow_lpm, "l/min", 0.1, 20, "each pump at full duty, full tank");
  a.field("spin_up_s", spin_up_s, "s", 0.01, 5, "rest to full duty");
  a.field("min_running_current_a", min_running_current_a, "A", 0.05, 20,
          "a running pump at full duty draws at least this");
  a.field("current_check_delay_s", current_check_delay_s, "s", 0.1, 10,
          "after switching on, before the current is judged");
  a.field("max_run_s", max_run_s, "s", 1, 600, "one uninterrupted run");
  a.field("tank_l", tank_l, "l", 0.1, 50, "each tank when full");
  a.field("empty_flow_drop", empty_flow_drop, "", 0, 0.9, "flow lost as a tank empties");
  a.field("max_setpoint_age_s", max_setpoint_age_s, "s", 0.05, 0.24,
          "older setpoints cut the pumps");
  a.field("max_state_age_s", max_state_age_s, "s", 0.05, 2, "older pump states cut the pumps");
  a.field("future_tolerance_s", future_tolerance_s, "s", 0, 0.5, "setpoints further ahead refused");
}

struct PumpController::Impl {
  using Duty = std::array<double, 2>;

  Impl(Config c, Pumps& device, const StopLatch& stop_latch)
      : config(c),
        pumps(device),
        stop(stop_latch),
        models{PumpModel({c.flow_lpm, c.spin_up_s, c.tank_l, c.empty_flow_drop}),
               PumpModel({c.flow_lpm, c.spin_up_s, c.tank_l, c.empty_flow_drop})} {}

  /// What the pumps shall do, and why not more.
  Duty decide(Stamp now, const std::optional<PumpsState>& state, std::string& blocked) {
    if (stop.latched()) {
      slot.clear();
      blocked = "STOP latched by " + stop.source();
      return {};
    }
    const auto taken = slot.take(now, fromSeconds(config.max_setpoint_age_s),
                                 fromSeconds(config.future_tolerance_s));
    if (!taken.setpoint) {
      blocked = taken.blocked;
      return {};
    }
    const Duty duty = taken.setpoint->duty;
    writer = taken.setpoint->writer;
    if (duty[0] <= 0.0 && duty[1] <= 0.0) {
      run_exhausted = false;
      return {};
    }
    if (run_exhausted) {
      blocked = fmt::format("ran for {:.0f} s without a break; set zero first", config.max_run_s);
      return {};
    }
    if (!state) {
      blocked = "no pump state yet";
      return {};
    }
    const double age = toSeconds(now - state->stamp);
    if (age > config.max_state_age_s) {
      blocked = fmt::format("pump state is {:.0f} ms old", 1e3 * age);
      return {};
    }
    return duty;
  }

  void watchRun(const Duty& duty, double dt) {
    const bool running = duty[0] > 0.0 || duty[1] > 0.0;
    run_s = running ? run_s + dt : 0.0;
    if (run_s > config.max_run_s) run_exhausted = true;
  }

  /// Dry, blocked or broken: the duty is applied, yet the motor draws less than a turning one.
  void watchCurrent(const Duty& duty, const std::optional<PumpsState>& state, double dt) {
    for (std::size_t i = 0; i < 2; ++i) {
      on_s[i] = duty[i] > kCheckedDuty ? on_s[i] + dt : 0.0;
      if (on_s[i] == 0.0) {
        no_current[i] = false;
      } else if (state && on_s[i] > config.current_check_delay_s) {
        no_current[i] = !(state->current_a[i] >= config.min_running_current_a * duty[i]);
      }
    }
  }

  void countWater(const Duty& duty, const std::optional<PumpsState>& state, double dt) {
    const bool cut = state && state->heartbeat_lost;
    for (std::size_t i = 0; i < 2; ++i) {
      sprayed_l += models[i].step(cut || no_current[i] ? 0.0 : duty[i], dt);
    }
  }

  void publish(Stamp now, const Duty& duty, const std::optional<PumpsState>& state,
               std::string blocked) {
    for (std::size_t i = 0; i < 2 && blocked.empty(); ++i) {
      if (no_current[i]) blocked = fmt::format("{} pump draws no current", kSide[i]);
    }
    tracking.stamp = now;
    tracking.duty = duty;
    if (state) {
      tracking.current_a = state->current_a;
      tracking.heartbeat_lost = state->heartbeat_lost;
    }
    tracking.tank_l_est = {models[0].level(), models[1].level()};
    tracking.sprayed_l_est = sprayed_l;
    tracking.pump_no_current = no_current;
    tracking.no_current = no_current[0] || no_current[1];
    tracking.spraying = duty[0] > 0.0 || duty[1] > 0.0;
    tracking.blocked = std::move(blocked);
    tracking.writer = tracking.spraying ? std::optional(writer) : std::nullopt;
  }

  Config config;
  Pumps& pumps;
  const StopLatch& stop;
  SetpointSlot<PumpSetpoint> slot;
  std::array<PumpModel, 2> models;
  std::array<double, 2> on_s{};
  std::array<bool, 2> no_current{};
  double run_s = 0.0, sprayed_l = 0.0;
  bool run_exhausted = false;
  Writer writer = Writer::Program;  ///< of the newest setpoint
  std::optional<Stamp> last_tick;
  mutable Mutex mutex;  ///< models, sprayed_l and tracking
  PumpTracking tracking;
};

PumpController::PumpController(Config config, Pumps& pumps, const StopLatch& stop)
    : impl_(std::make_unique<Impl>(config, pumps, stop)) {
  impl_->tracking.tank_l_est = {config.tank_l, config.tank_l};
}
PumpController::~PumpController() = default;

void PumpController::setpoint(const PumpSetpoint& setpoint) {
  PumpSetpoint clamped = setpoint;
  for (double& duty : clamped.duty) {
    if (!std::isfinite(duty)) {
      impl_->slot.refuse("setpoint is not a number");
      return;
    }
    duty = std::clamp(duty, 0.0, 1.0);
  }
  impl_->slot.put(clamped);
}

void PumpController::restoreEstimate(double sprayed_l, std::array<double, 2> tank_l) {
  const std::lock_guard lock(impl_->mutex);
  impl_->sprayed_l = sprayed_l;
  for (std::size_t i = 0; i < 2; ++i) impl_->models[i].setLevel(tank_l[i]);
  impl_->tracking.sprayed_l_est = sprayed_l;
  impl_->tracking.tank_l_est = {impl_->models[0].level(), impl_->models[1].level()};
}

void PumpController::tick(Stamp now) {
  Impl& m = *impl_;
  const double dt = m.last_tick ? std::clamp(toSeconds(now - *m.last_tick), 0.0, kMaxTick) : 0.0;
  m.last_tick = now;
  const std::optional<PumpsState> state = m.pumps.state();
  std::string blocked;
  const Impl::Duty duty = m.decide(now, state, blocked);
  const auto written = m.pumps.write(duty);  // zeros too: the heartbeat must not miss a beat
  if (!written && blocked.empty()) blocked = written.error().message;
  const std::lock_guard lock(m.mutex);
  m.watchRun(duty, dt);
  m.watchCurrent(duty, state, dt);
  m.countWater(written ? duty : Impl::Duty{}, state, dt);
  m.publish(now, duty, state, std::move(blocked));
}

PumpTracking PumpController::tracking() const {
  const std::lock_guard lock(impl_->mutex);
  return impl_->tracking;
}

}  // namespace kiln
