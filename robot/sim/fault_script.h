#pragma once

#include <string_view>
#include <vector>

#include "common/core/stamp.h"
#include "robot/sim/world_config.h"

namespace kiln::sim {

/// The scripted faults of one run.
class FaultScript {
 public:
  explicit FaultScript(std::vector<FaultConfig> faults) : faults_(std::move(faults)) {}
  [[nodiscard]] bool active(std::string_view name, Stamp now) const {
    const double t = toSeconds(now);
    for (const FaultConfig& f : faults_) {
      if (f.name == name && t >= f.at_s && t < f.at_s + f.duration_s) return true;
    }
    return false;
  }

 private:
  std::vector<FaultConfig> faults_;
};

}  // namespace kiln::sim
