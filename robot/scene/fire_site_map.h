#pragma once

#include <string>
#include <vector>

#include "robot/scene/arena_map.h"

namespace kiln {

/// One of the known fire places: where the plate is expected and from where the robot works on it.
struct FirePlaceConfig {
  std::string name;
  std::vector<double> plate_xyz_m{0, 0, 1};  ///< plate centre in map
  double facing_deg = 180.0;          ///< yaw of the plate's outward normal, through the opening
  GroundPoseConfig work_pose;         ///< base pose in front of it
  std::vector<GroundPoseConfig> via;  ///< on the way there from the hub inside the building
  void visit(ConfigArchive& a);
};

/// Nominal model of the fire places of Challenge 3, as the autonomy and the station know them
/// (resources/config/fire_site_kitchen.yaml). The simulator builds its own from it with the errors
/// of scenario.md section 3.
struct FireSiteMap {
  std::vector<FirePlaceConfig> places;  ///< in the order of visits
  // Fire box (acrylic), same at all places; sizes from the rules.
  double box_size_m = 0.4;
  double opening_m = 0.15;  ///< round opening, diameter
  double plate_m = 0.15;    ///< plate diameter
  double recess_m = 0.10;   ///< plate behind the opening
  double table_size_m = 0.7, table_height_m = 0.8;
  void visit(ConfigArchive& a);
  /// nullptr: there is none of that name.
  [[nodiscard]] const FirePlaceConfig* place(const std::string& name) const;
  /// Pose of a place's front: middle of the opening, in the outer face of the box, X outward.
  [[nodiscard]] Eigen::Isometry3d front(const Eigen::Vector3d& p_plate_map,
                                        double facing_rad) const;
  /// The place stands elsewhere than was configured: moves its plate, and the pose from which the
  /// robot works on it along. @pre index < places.size().
  void movePlace(std::size_t index, const Eigen::Vector3d& p_plate_map, double facing_rad);
  /// Tables and boxes, and the ways to them.
  [[nodiscard]] SiteFixtures fixtures() const;
};

inline constexpr const char* kFireSite = "fire";  ///< its key in ArenaMap::sites

/// From the file that the arena names; no places when it names none.
/// Errors: those of loadComplete(): without its places a file is refused.
[[nodiscard]] Result<FireSiteMap> loadFireSite(const ArenaMap& arena);

}  // namespace kiln
