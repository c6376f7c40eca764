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
  /// The first of that name that is on; nullptr: none.
  [[nodiscard]] const FaultConfig* find(std::string_view name, Stamp now) const {
    const double t = toSeconds(now);
    for (const FaultConfig& f : faults_) {
      if (f.name == name && t >= f.at_s && t < f.at_s + f.duration_s) return &f;
    }
    return nullptr;
  }
  [[nodiscard]] bool active(std::string_view name, Stamp now) const {
    return find(name, now) != nullptr;
  }
  [[nodiscard]] const std::vector<FaultConfig>& all() const { return faults_; }

 private:
  std::vector<FaultConfig> faults_;
};

}  // namespace kiln::sim
