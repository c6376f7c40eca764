#pragma once

#include <map>
#include <string>
#include <vector>

#include "common/config/config_archive.h"
#include "common/geom/pose.h"
#include "common/robot_model/robot_geometry.h"
#include "robot/scene/ground_profile.h"

namespace kiln {

/// Pose on the ground as it stands in YAML: [x m, y m, yaw deg].
struct GroundPoseConfig {
  std::vector<double> xy_m{0, 0};
  double yaw_deg = 0.0;
  void visit(ConfigArchive& a);
  [[nodiscard]] Pose2 pose() const;
};

/// A point on the ground as it stands in YAML: [x m, y m].
struct GroundPointConfig {
  std::vector<double> xy_m{0, 0};
  void visit(ConfigArchive& a);
};

/// A mission's site in the arena, in a file of its own.
struct SiteConfig {
  std::string mission;  ///< name in the catalogue
  std::string file;     ///< below resources/
  void visit(ConfigArchive& a);
};

/// What a site puts into the arena, whichever mission runs.
struct SiteFixtures {
  std::vector<BoxConfig> boxes;          ///< obstacles, where they are believed to stand now
  std::vector<GroundPoseConfig> stands;  ///< where a robot that works there, or goes there, stands
};

/// Nominal model of the arena in `map`, as the autonomy and the station know it
/// (resources/config/arena_kitchen.yaml). The simulator builds its world from it with the per-seed
/// errors of scenario.md section 3.
struct ArenaMap {
  std::string name = "kitchen";
  GroundPoseConfig start;                    ///< nominal start pose
  ApproachConfig approach;                   ///< ramp and edge as surveyed; all zero: flat
  std::vector<BoxConfig> walls;              ///< fixed structure: exact up to 2 mm in the world
  std::vector<BoxConfig> furniture;          ///< known only roughly (+-15 cm)
  GroundPoseConfig doorway;                  ///< middle of the entrance, X into the building
  std::vector<GroundPoseConfig> entry_path;  ///< way-points start -> inside (last one is the hub)
  /// Way-points of the mapping drive (mission `mapping`): from the start through the building and
  /// back to the start. Empty: none can be driven.
  std::vector<GroundPoseConfig> mapping_path;
  std::vector<SiteConfig> sites;
  std::map<std::string, SiteFixtures> fixtures;  ///< by mission; not in the file: furnish()
  /// Border of the arena: corners in order. The whole robot stays inside, also in teleoperation.
  /// Empty: the box of the four limits below.
  std::vector<GroundPointConfig> geofence;
  double geofence_x_min_m = -3, geofence_x_max_m = 16, geofence_y_min_m = -7, geofence_y_max_m = 7;
  void visit(ConfigArchive& a);
};

}  // namespace kiln
