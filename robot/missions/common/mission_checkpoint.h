#pragma once

#include <string>
#include <vector>

#include "common/core/error.h"
#include "common/model/status.h"
#include "robot/fsm/machine.h"
#include "robot/world_model/world_state.h"

namespace kiln {

/// Everything that a mission needs to go on after its program was killed: where the state machine
/// stood and what the robot believed.
struct MissionCheckpoint {
  static constexpr int kVersion = 1;
  Stamp stamp;
  FsmCheckpoint fsm;
  WorldState world;
  /// Why the mission stood still; empty: it ran, and --resume may go on by itself.
  std::vector<MissionHold> holds{};
};

[[nodiscard]] std::string encodeCheckpoint(const MissionCheckpoint& checkpoint);
/// @param name  of the file, for messages.
/// Error: Truncated (not whole), VersionMismatch (another format or version), InvalidInput (a key
/// is missing or wrong).
[[nodiscard]] Result<MissionCheckpoint> decodeCheckpoint(const std::string& text,
                                                         const std::string& name);

[[nodiscard]] Result<MissionCheckpoint> loadCheckpoint(const std::string& path);

}  // namespace kiln
