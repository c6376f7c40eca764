#pragma once

#include <array>

#include "common/core/stamp.h"
#include "common/model/sensor.h"
#include "robot/sim/random.h"
#include "robot/sim/world_config.h"

namespace kiln::sim {

/// Two tanks, two pumps and the Nano that cuts them when its heartbeat stops. Thread-compatible.
class PumpDevice {
 public:
  PumpDevice(const WaterConfig& config, std::uint64_t seed);

  /// A heartbeat with both duties. @return empty, or why it was refused.
  std::string write(Stamp now, const std::array<double, 2>& duty);
  void setBlocked(std::size_t pump, bool blocked) { blocked_[pump] = blocked; }
  /// @return litres that left the nozzle in this step.
  double step(Stamp now, double step_s);
  [[nodiscard]] PumpsState report(Stamp now);

  /// Share of the nominal flow of both pumps; the jet's exit speed goes with it.
  [[nodiscard]] double flowFraction() const { return flow_fraction_; }
  [[nodiscard]] double tank(std::size_t pump) const { return tank_l_[pump]; }
  [[nodiscard]] double fullFlow(std::size_t pump) const { return full_flow_lpm_[pump]; }
  /// How long either pump has been driven, seconds.
  [[nodiscard]] double onTime() const { return on_s_; }

 private:
  WaterConfig config_;
  Random noise_;
  std::array<double, 2> full_flow_lpm_{}, tank_l_{}, duty_{}, spin_{};
  std::array<bool, 2> blocked_{};
  double flow_fraction_ = 0.0, on_s_ = 0.0;
  Stamp heartbeat_;
  bool ever_ = false, lost_ = false;
};

}  // namespace kiln::sim
