#pragma once

#include <span>
#include <string>
#include <vector>

#include "robot/sim/world_config.h"

namespace kiln::sim {

/// One fault that can be scripted.
struct FaultKind {
  const char* name;
  const char* values;            ///< what its numbers mean; empty: it takes none
  std::vector<double> defaults;  ///< of those numbers
  bool from_start;               ///< part of the drawn world: begins at 0, lasts for ever
  const char* doc;
};

[[nodiscard]] std::span<const FaultKind> faultKinds();
/// Known name, sane times, not too many numbers.
[[nodiscard]] Result<void> checkFault(const FaultConfig& fault);
/// The fault's i-th number, or the default of its kind. @pre checkFault(fault), i <
/// defaults.size().
[[nodiscard]] double faultValue(const FaultConfig& fault, std::size_t i);
/// For `kiln-sim --help`: one paragraph per fault.
[[nodiscard]] std::string faultHelp();

}  // namespace kiln::sim
