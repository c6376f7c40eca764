#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "robot/hal/device_set.h"
#include "robot/missions/common/mission.h"
#include "robot/missions/common/mission_config.h"
#include "robot/missions/common/mission_parts.h"

namespace kiln {

/// One mission that a robot can be started with. To add one: a folder, and a line in catalog.cpp
/// (resources/docs/extending.md).
struct MissionKind {
  std::string name;           ///< of --mission, and of its section in the robot's configuration
  std::string doc;            ///< for --help
  std::string default_world;  ///< file name in resources/worlds, without .yaml
  /// What differs from the robot's shipped configuration, as --set takes it. A file that the
  /// operator names, and --set, come after it.
  std::vector<std::string> settings;
  std::function<std::unique_ptr<MissionConfig>()> config;
  /// @param config  made by config(). Error: what is wrong with it or with the arena.
  std::function<Result<std::unique_ptr<Mission>>(
      const MissionConfig& config, const std::string& mission_uuid, const MissionParts& parts)>
      make;
  DeviceSet needs{};  ///< without them it does not start
  /// What its site puts into the arena, whichever mission runs; empty: it has no site of its own.
  std::function<Result<SiteFixtures>(const ArenaMap& arena)> site{};
};

}  // namespace kiln
