#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>

#include "common/config/config_archive.h"
#include "common/core/clock.h"
#include "robot/control/writer.h"
#include "robot/hal/pumps.h"
#include "robot/safety/stop_latch.h"

namespace kiln {

struct PumpSetpoint {
  Stamp stamp;
  Duration ttl = std::chrono::milliseconds(200);
  std::array<double, 2> duty{};  ///< 0..1, left and right
  Writer writer = Writer::Program;
  [[nodiscard]] bool rests() const { return duty[0] == 0.0 && duty[1] == 0.0; }
};

/// Litres are a pump model times time: there is no flow sensor; every figure is an estimate.
struct PumpTracking {
  Stamp stamp;
  std::array<double, 2> duty{};
  std::array<double, 2> current_a{};
  std::array<double, 2> tank_l_est{5.0, 5.0};
  double sprayed_l_est = 0.0;             ///< since the mission began
  std::array<bool, 2> pump_no_current{};  ///< which one, left and right
  bool no_current =
      false;  ///< duty given, but a pump draws less than a running one: dry, blocked or broken
  bool heartbeat_lost = false;
  bool spraying = false;
  std::string blocked;
  std::optional<Writer> writer;  ///< as of BaseTracking
};

/// Feeds the pump heartbeat, cuts the pumps on STOP, stale setpoints and too long a run, counts
/// estimated litres. setpoint()/tracking() thread-safe; tick() confined to the control thread.
class PumpController {
 public:
  struct Config {
    double flow_lpm = 1.6;  ///< each pump at full duty
    double spin_up_s = 0.4;
    double min_running_current_a = 1.0;
    double current_check_delay_s = 0.6;
    double max_run_s = 120.0;  ///< one uninterrupted run
    double tank_l = 5.0;
    double empty_flow_drop = 0.2;  ///< flow lost as a tank empties, linear
    double max_setpoint_age_s =
        0.2;                       ///< pumps are cut at the smaller of this and the setpoint's ttl
    double max_state_age_s = 0.3;  ///< without the pump board's report no pump runs
    double future_tolerance_s = 0.05;  ///< setpoints stamped further ahead are refused
    void visit(ConfigArchive& a);
  };
  PumpController(Config config, Pumps& pumps, const StopLatch& stop);
  ~PumpController();
  void setpoint(const PumpSetpoint& setpoint);
  /// After --resume: continue the estimate.
  void restoreEstimate(double sprayed_l, std::array<double, 2> tank_l);
  void tick(Stamp now);
  [[nodiscard]] PumpTracking tracking() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace kiln
