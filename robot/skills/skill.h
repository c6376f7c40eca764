#pragma once

#include <string>

namespace kiln {

/// Skills are started, then polled at 50 Hz from the mission tick; they never block.
enum class SkillPhase { Idle, Running, Done, Failed };

struct SkillStatus {
  SkillPhase phase = SkillPhase::Idle;
  double progress = 0.0;     ///< 0..1
  std::string text;          ///< for the operator: "0.12 m to go", or why it failed
  std::string failure_code;  ///< "contact", "protective_stop", "unreachable", "in_collision",
                             ///< "timeout", "geofence", ...
};

}  // namespace kiln
