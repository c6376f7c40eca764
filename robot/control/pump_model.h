#pragma once

#include <algorithm>

namespace kiln {

/// What one pump and its tank are believed to do: flow rises linearly to the duty within the
/// spin-up time and falls a little as the tank empties. An estimate: nothing measures flow or
/// level. Thread-compatible.
class PumpModel {
 public:
  struct Config {
    double flow_lpm = 1.6;   ///< at full duty and a full tank
    double spin_up_s = 0.4;  ///< from rest to full duty
    double tank_l = 5.0;
    double empty_flow_drop = 0.2;  ///< fraction of the flow lost when the tank is empty
  };
  explicit PumpModel(Config config) : config_(config), level_l_(config.tank_l) {}

  /// @return litres that left the nozzle during dt at this duty (0..1).
  double step(double duty, double dt_s) {
    const double rate = dt_s / config_.spin_up_s;
    const double before = speed_;
    speed_ = duty > speed_ ? std::min(duty, speed_ + rate) : std::max(duty, speed_ - rate);
    const double emptied = 1.0 - level_l_ / config_.tank_l;
    const double flow_lps = config_.flow_lpm / 60.0 * 0.5 * (before + speed_);
    const double litres =
        std::min(level_l_, flow_lps * (1.0 - config_.empty_flow_drop * emptied) * dt_s);
    level_l_ -= litres;
    return litres;
  }
  void setLevel(double litres) { level_l_ = std::clamp(litres, 0.0, config_.tank_l); }
  [[nodiscard]] double level() const { return level_l_; }

 private:
  Config config_;
  double speed_ = 0.0;  ///< 0..1
  double level_l_;
};

}  // namespace kiln
