#pragma once

#include <optional>
#include <vector>

#include "common/core/stamp.h"
#include "common/geom/pose.h"

namespace kiln {

/// Poses over time, interpolated between samples; held constant before the first and after the
/// last. Thread-compatible.
class PoseTrack {
 public:
  /// @pre stamps do not decrease.
  void push(Stamp stamp, const Eigen::Isometry3d& X);
  [[nodiscard]] bool empty() const { return samples_.empty(); }
  /// @pre not empty.
  [[nodiscard]] Eigen::Isometry3d at(Stamp stamp) const;

 private:
  struct Sample {
    Stamp stamp;
    Eigen::Isometry3d X;
  };
  std::vector<Sample> samples_;
};

}  // namespace kiln
