#pragma once

#include <string>
#include <vector>

#include "robot/scene/arena_map.h"
#include "robot/scene/pile_layout.h"

namespace kiln {

/// A PileStack as it is written in a file.
struct BrickStackConfig {
  std::string kind = "red";  ///< a name of kBrickShapes
  int line = 1;              ///< 1: the first line, 2: behind it
  int bricks = 5;
  void visit(ConfigArchive& a);
  [[nodiscard]] PileStack stack() const;
};

/// Nominal site of Challenge 2, as the autonomy and the station know it
/// (resources/config/wall_site_*.yaml). The simulator draws its own from it with the errors of
/// scenario.md section 4.
/// Pile frame: pile_layout.h; wall frame: wall_layout.h.
struct WallSiteMap {
  GroundPoseConfig pile;                       ///< X_map_pile, known to known_m and known_deg
  GroundPoseConfig marker;                     ///< X_map_wall, likewise
  double known_m = 1.0, known_deg = 10.0;      ///< how well both are known, +-
  std::vector<BrickStackConfig> stacks;        ///< each line's follow each other along X
  double stack_gap_m = 0.1;                    ///< between the stacks of a line
  double line_distance_m = 2.6;                ///< between the middles of lines 1 and 2
  std::vector<GroundPointConfig> search_area;  ///< nothing outside is taken for pile or marker
  void visit(ConfigArchive& a);
  /// Error: pile or marker lies outside of the search area.
  [[nodiscard]] Result<void> validate() const;
  [[nodiscard]] PileLayout layout() const;
  /// The stacks as boxes where they are believed to stand, and stands before pile and marker.
  [[nodiscard]] SiteFixtures fixtures() const;
};

inline constexpr const char* kWallSite = "wall";  ///< its key in ArenaMap::sites

/// From the file that the arena names; no stacks when it names none.
/// Errors: those of loadComplete() and validate().
[[nodiscard]] Result<WallSiteMap> loadWallSite(const ArenaMap& arena);

}  // namespace kiln
