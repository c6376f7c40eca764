#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/geom/pose.h"

namespace kiln {

/// Where the base truly was, 10 times a second, out of the world's trace.
class BaseTrace {
 public:
  /// @param jsonl  as kiln-sim --truth-trace writes it; lines that cannot be read are left out.
  explicit BaseTrace(const std::string& jsonl);
  /// Interpolated; nullopt before the first and after the last sample.
  [[nodiscard]] std::optional<Pose2> at(double t_s) const;

 private:
  struct Sample {
    double t_s = 0.0;
    Pose2 X_map_base;
  };
  std::vector<Sample> samples_;
};

}  // namespace kiln
