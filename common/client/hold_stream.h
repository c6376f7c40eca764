#pragma once

#include <array>
#include <optional>
#include <vector>

#include "common/model/command.h"
#include "common/transport/monotonic.h"

namespace kiln {

/// The station's half of hold-to-run: streams the newest setpoint of each kind at a fixed rate
/// while its caller keeps repeating it, then sends zero three times and falls silent.
/// Thread-compatible.
class HoldStream {
 public:
  HoldStream(double rate_hz, double ttl_s) : period_s_(1.0 / rate_hz), ttl_s_(ttl_s) {}

  /// Ignored for anything that is not a setpoint of one kind.
  void hold(CommandBody setpoint, Monotonic::time_point now);
  void release(const CommandBody& example);
  void releaseAll();
  /// What is to be sent now.
  [[nodiscard]] std::vector<CommandBody> due(Monotonic::time_point now);
  [[nodiscard]] bool active() const;

 private:
  static constexpr std::size_t kKinds = 4;
  struct Slot {
    CommandBody body;
    Monotonic::time_point refreshed;
    bool held = false;
    int zeros_left = 0;
  };
  [[nodiscard]] bool anyHeld() const;

  double period_s_;
  double ttl_s_;
  std::array<Slot, kKinds> slots_;
  std::optional<Monotonic::time_point> last_sent_;
};

}  // namespace kiln
