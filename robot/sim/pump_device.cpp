#include "robot/sim/pump_device.h"

#include <algorithm>
#include <cmath>

namespace kiln::sim {

PumpDevice::PumpDevice(const WaterConfig& config, std::uint64_t seed)
    : config_(config), noise_(seed, "pump current") {
  Random random(seed, "pumps");
  for (std::size_t i = 0; i < 2; ++i) {
    full_flow_lpm_[i] =
        config.flow_lpm * (1.0 + random.uniform(-config.flow_spread, config.flow_spread));
    tank_l_[i] = config.tank_l;
  }
}

std::string PumpDevice::write(Stamp now, const std::array<double, 2>& duty) {
  for (const double d : duty) {
    if (!(d >= 0.0 && d <= 1.0)) return "pump duty outside 0 to 1";  // also NaN
  }
  duty_ = duty;
  heartbeat_ = now;
  ever_ = true;
  lost_ = false;
  return {};
}

double PumpDevice::step(Stamp now, double step_s) {
  if (ever_ && toSeconds(now - heartbeat_) > config_.watchdog_s) {
    lost_ = true;
    duty_ = {};
  }
  double litres = 0.0;
  for (std::size_t i = 0; i < 2; ++i) {
    const double reach = step_s / config_.spin_up_s;
    spin_[i] += std::clamp(duty_[i] - spin_[i], -reach, reach);
    if (blocked_[i] || tank_l_[i] <= 0.0) continue;
    const double level = tank_l_[i] / config_.tank_l;
    const double flow_lpm =
        full_flow_lpm_[i] * spin_[i] * (1.0 - config_.empty_loss * (1.0 - level));
    const double out = std::min(tank_l_[i], flow_lpm / 60.0 * step_s);
    tank_l_[i] -= out;
    litres += out;
  }
  flow_fraction_ = litres / (2.0 * config_.flow_lpm / 60.0 * step_s);
  if (duty_[0] > 0.0 || duty_[1] > 0.0) on_s_ += step_s;
  return litres;
}

PumpsState PumpDevice::report(Stamp now) {
  PumpsState state;
  state.stamp = now;
  state.duty = duty_;
  state.heartbeat_lost = lost_;
  for (std::size_t i = 0; i < 2; ++i) {
    const bool loaded = !blocked_[i] && tank_l_[i] > 0.0;
    double current = config_.idle_a;
    if (duty_[i] > 0.0) {
      current = duty_[i] * (loaded ? config_.running_a : config_.dry_a);
      if (loaded && spin_[i] < duty_[i]) current += config_.surge_a * (1.0 - spin_[i] / duty_[i]);
    }
    state.current_a[i] = std::max(0.0, current + noise_.normal(config_.current_noise_a));
  }
  return state;
}

}  // namespace kiln::sim
