#pragma once

#include <memory>
#include <string>
#include <vector>

#include "robot/localization/surfel_map.h"

namespace kiln {

/// One map of a set; all maps of a set share the frame `map`.
struct MapSegment {
  std::string name;  ///< "outdoor", "indoor"
  std::shared_ptr<const SurfelMap> map;
};

/// What a map file holds: separate maps of one place, because inside and outside points lie close
/// together and the fine level can be centred where it is needed (NimbRo UGV paper, "Laser
/// Navigation").
struct LocalizationMap {
  std::string arena;  ///< name of the arena in whose frame it is
  std::vector<MapSegment> segments;
  std::uint64_t checksum = 0;  ///< of the file that it was read from; 0: of no file
  /// nullptr if there is none of that name.
  [[nodiscard]] std::shared_ptr<const SurfelMap> find(const std::string& name) const;
};

inline constexpr std::uint32_t kMapFileVersion = 1;

/// Means are kept to 1/256 of a cell, covariances to 1 mm at the finest level; a cell seen by fewer
/// than `min_points` points is left out. Same map, same bytes. Error: Storage.
[[nodiscard]] Result<void> saveMap(const LocalizationMap& map, const std::string& path,
                                   int min_points = 3);
/// The maps are refreshed and ready for matching. Error: NotFound, InvalidInput (not a map file, or
/// contents out of range), VersionMismatch, Truncated (also: bytes changed).
[[nodiscard]] Result<LocalizationMap> loadMap(const std::string& path);
/// The same on bytes. @param name  of the source, for the error text.
[[nodiscard]] std::string encodeMap(const LocalizationMap& map, int min_points = 3);
[[nodiscard]] Result<LocalizationMap> decodeMap(const std::string& bytes, const std::string& name);

}  // namespace kiln
