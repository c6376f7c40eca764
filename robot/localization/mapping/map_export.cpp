#include "robot/localization/mapping/map_export.h"

#include <fmt/format.h>

#include "common/core/atomic_file.h"

namespace kiln {
namespace {

/// Planes that no finer level shows.
std::vector<Surfel> finest(const LocalizationMap& map) {
  std::vector<Surfel> out;
  for (const MapSegment& segment : map.segments) {
    for (int level = 0; level < segment.map->config().levels; ++level) {
      for (const Surfel& surfel : segment.map->surfels(level)) {
        if (level == 0 || !segment.map->covers(level - 1, surfel.mean.cast<double>()))
          out.push_back(surfel);
      }
    }
  }
  return out;
}

/// `header` with the number of surfels in it, then a row a surfel.
Result<void> writeRows(const LocalizationMap& map, const std::string& path,
                       fmt::string_view header) {
  const std::vector<Surfel> surfels = finest(map);
  std::string out = fmt::vformat(header, fmt::make_format_args(surfels.size()));
  for (const Surfel& s : surfels) {
    out += fmt::format("{:.4f} {:.4f} {:.4f} {:.4f} {:.4f} {:.4f} {:.0f}\n", s.mean.x(), s.mean.y(),
                       s.mean.z(), s.normal.x(), s.normal.y(), s.normal.z(), s.count);
  }
  return writeFileAtomically(path, out);
}

}  // namespace

Result<void> exportPcd(const LocalizationMap& map, const std::string& path) {
  return writeRows(map, path,
                   "# .PCD v0.7\nVERSION 0.7\nFIELDS x y z normal_x normal_y normal_z count\n"
                   "SIZE 4 4 4 4 4 4 4\nTYPE F F F F F F F\nCOUNT 1 1 1 1 1 1 1\nWIDTH {0}\n"
                   "HEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS {0}\nDATA ascii\n");
}

Result<void> exportPly(const LocalizationMap& map, const std::string& path) {
  return writeRows(map, path,
                   "ply\nformat ascii 1.0\nelement vertex {0}\nproperty float x\n"
                   "property float y\nproperty float z\nproperty float nx\n"
                   "property float ny\nproperty float nz\nproperty float count\nend_header\n");
}

}  // namespace kiln
