#pragma once

#include <string>
#include <vector>

#include "common/core/error.h"
#include "robot/localization/mapping/map_builder.h"

namespace kiln {

struct MapCommandOptions {
  std::vector<std::string> recordings;  ///< of kiln-robotd --record; the first begins at the start
  std::string out;                      ///< map file
  std::string arena = "config/arena_kitchen.yaml";  ///< resource
  std::string geometry = "robot_model/bob.yaml";    ///< resource
  std::string pcd, ply;                             ///< also write the surfels for other programs
  std::string json;                                 ///< also write the report
  bool close_loops = true;                          ///< false: to see what they are good for
};

struct MadeMap {
  BuiltMap built;
  std::string text;  ///< the report, for people
};

/// `kiln-eval map RUN.mcap -o kitchen.map`: builds the localisation map from recorded scans and
/// wheel odometry and says how good it is. Error: what is wrong with a recording, or why no map
/// comes of it.
[[nodiscard]] Result<MadeMap> makeMap(const MapCommandOptions& options);

}  // namespace kiln
