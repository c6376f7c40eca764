#pragma once

#include <string>
#include <vector>

#include "common/core/error.h"

namespace kiln {

struct MapCommandOptions {
  std::vector<std::string> recordings;  ///< of kiln-robotd --record; the first begins at the start
  std::string out;                      ///< map file
  std::string arena = "config/arena_kitchen.yaml";  ///< resource
  std::string geometry = "robot_model/bob.yaml";    ///< resource
  std::string pcd, ply;                             ///< also write the surfels for other programs
  std::string json;                                 ///< also write the report
};

/// `kiln-eval map RUN.mcap -o kitchen.map`: builds the localisation map from recorded scans and
/// wheel odometry and prints how good it is. Error: what is wrong with a recording, or why no map
/// comes of it.
[[nodiscard]] Result<std::string> makeMap(const MapCommandOptions& options);

}  // namespace kiln
