#pragma once

#include <cstdint>
#include <optional>

#include <nlohmann/json_fwd.hpp>

#include "common/core/error.h"
#include "common/core/stamp.h"
#include "common/geom/pose.h"

namespace kiln {

/// What the robot believes of itself, whatever its mission, and what survives a restart of the
/// program. `map`, metres, radians. Confined to the mission thread.
struct RobotBelief {
  bool clock_started = false;
  Stamp clock_start;  ///< robot time at which the mission clock began
  int resets = 0;     ///< during this mission
  Pose2 X_map_base;   ///< newest known pose
  Stamp pose_stamp;
  /// How often the devices said that the robot was carried back, when that was last heard; nullopt:
  /// never heard. Another number after a restart: it was carried while the program was dead.
  std::optional<std::uint32_t> device_resets;

  /// Seconds on the mission clock; 0 before its start. It runs on through pauses and resets.
  [[nodiscard]] double elapsedS(Stamp now) const {
    return clock_started ? toSeconds(now - clock_start) : 0.0;
  }
  void startClock(Stamp now) {
    clock_started = true;
    clock_start = now;
  }
  /// When robot time began anew since `saved_at` (now < saved_at, the computer was restarted), the
  /// mission clock goes on from where it stood; else the downtime counts.
  void continueClock(Stamp saved_at, Stamp now);
};

[[nodiscard]] nlohmann::json beliefToJson(const RobotBelief& belief);
/// Error{InvalidInput}: names the first key that is missing, of the wrong type or out of range.
[[nodiscard]] Result<RobotBelief> beliefFromJson(const nlohmann::json& json);

}  // namespace kiln
