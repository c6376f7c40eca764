#pragma once

#include <memory>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "common/core/error.h"
#include "common/model/status.h"
#include "robot/fsm/machine.h"
#include "robot/world_model/robot_belief.h"

namespace kiln {

/// Everything that a mission needs to go on after its program was killed: where the state machine
/// stood, what the robot believed, and what the mission says of itself.
struct MissionCheckpoint {
  static constexpr int kVersion = 2;
  Stamp stamp;
  FsmCheckpoint fsm;
  /// Why the mission stood still; empty: it ran, and --resume may go on by itself.
  std::vector<MissionHold> holds{};
  RobotBelief robot{};
  std::shared_ptr<const nlohmann::json> log{};      ///< MissionLog::save()
  std::shared_ptr<const nlohmann::json> mission{};  ///< Mission::save()
};

/// JSON with a CRC-32 over its body.
[[nodiscard]] std::string encodeCheckpoint(const MissionCheckpoint& checkpoint);
/// @param name  of the file, for messages.
/// Error: Truncated (not whole), VersionMismatch (another format or version), InvalidInput (the
/// checksum does not fit, or a key is missing, wrong or out of range).
[[nodiscard]] Result<MissionCheckpoint> decodeCheckpoint(const std::string& text,
                                                         const std::string& name);

[[nodiscard]] Result<MissionCheckpoint> loadCheckpoint(const std::string& path);

}  // namespace kiln
