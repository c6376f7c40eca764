#pragma once

#include <deque>
#include <optional>

#include "common/model/sensor.h"

namespace kiln {

/// The last few seconds of joint angles, so that a scan can be matched with where the arm was at
/// each of its points. Thread-compatible.
class ArmTrack {
 public:
  explicit ArmTrack(Duration kept = std::chrono::seconds(2)) : kept_(kept) {}
  /// Samples older than the newest one or not finite are ignored.
  void push(Stamp stamp, const Vector6d& q);
  void push(const ArmState& state) { push(state.stamp, state.q); }
  [[nodiscard]] bool empty() const { return samples_.empty(); }
  /// Linear between samples, held constant outside. nullopt if there is none yet.
  [[nodiscard]] std::optional<Vector6d> at(Stamp stamp) const;

 private:
  struct Sample {
    Stamp stamp;
    Vector6d q;
  };
  Duration kept_;
  std::deque<Sample> samples_;
};

}  // namespace kiln
