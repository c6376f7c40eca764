#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "common/model/command.h"
#include "common/transport/monotonic.h"

namespace kiln {

/// The station's half of hold-to-run: streams the newest setpoint of each kind at a fixed rate
/// while its caller keeps repeating it, then sends zero three times and falls silent. A press that
/// has ended, by its caller or by silence, is over here as it is on the robot: repeating it sends
/// nothing. Thread-compatible.
class HoldStream {
 public:
  struct Setpoint {
    CommandBody body;
    std::uint64_t press = 0;  ///< 0: a release
  };
  HoldStream(double rate_hz, double ttl_s) : period_s_(1.0 / rate_hz), ttl_s_(ttl_s) {}

  /// A number for a press that begins now; grows.
  [[nodiscard]] std::uint64_t press() { return ++last_press_; }
  /// Ignored for anything that is not a setpoint of one kind, and for a press that is over.
  void hold(CommandBody setpoint, std::uint64_t press, Monotonic::time_point now);
  void release(const CommandBody& example);
  void releaseAll();
  /// What is to be sent now.
  [[nodiscard]] std::vector<Setpoint> due(Monotonic::time_point now);
  [[nodiscard]] bool active() const;

 private:
  static constexpr std::size_t kKinds = 4;
  struct Slot {
    CommandBody body;
    std::uint64_t press = 0;
    std::uint64_t over = 0;  ///< newest press that has ended
    Monotonic::time_point refreshed;
    bool held = false;
    int zeros_left = 0;
  };
  [[nodiscard]] bool anyHeld() const;

  double period_s_;
  double ttl_s_;
  std::array<Slot, kKinds> slots_;
  std::optional<Monotonic::time_point> last_sent_;
  std::uint64_t last_press_ = 0;
};

}  // namespace kiln
