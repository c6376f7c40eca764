#pragma once

#include <string>

#include "robot/localization/surfel_map_file.h"

namespace kiln {

/// Surfels of all segments, finest first, as points with normals for other programs: PCD 0.7 and
/// PLY, both ASCII, map frame, metres. Error: Storage.
[[nodiscard]] Result<void> exportPcd(const LocalizationMap& map, const std::string& path);
[[nodiscard]] Result<void> exportPly(const LocalizationMap& map, const std::string& path);

}  // namespace kiln
