#pragma once

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

/// One of the two known fire places: where the plate is expected and from where the robot works on
/// it.
struct FirePlaceConfig {
  std::string name;
  std::vector<double> plate_xyz_m{0, 0, 1};  ///< plate centre in map
  double facing_deg = 180.0;   ///< yaw of the plate's outward normal, through the opening
  GroundPoseConfig work_pose;  ///< base pose in front of it
  std::vector<GroundPoseConfig>
      via;  ///< way-points on the way there from the hub inside the building
  void visit(ConfigArchive& a);
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
  std::vector<FirePlaceConfig> fire_places;
  /// Border of the arena: corners in order. The whole robot stays inside, also in teleoperation.
  /// Empty: the box of the four limits below.
  std::vector<GroundPointConfig> geofence;
  double geofence_x_min_m = -3, geofence_x_max_m = 16, geofence_y_min_m = -7, geofence_y_max_m = 7;
  // Fire box (acrylic), same at both places; sizes from the rules.
  double box_size_m = 0.4;
  double opening_m = 0.15;  ///< round opening, diameter
  double plate_m = 0.15;    ///< plate diameter
  double recess_m = 0.10;   ///< plate behind the opening
  double table_size_m = 0.7, table_height_m = 0.8;
  void visit(ConfigArchive& a);
  /// Pose of a fire place's front: middle of the opening, in the outer face of the box, X outward.
  [[nodiscard]] Eigen::Isometry3d front(const Eigen::Vector3d& p_plate_map,
                                        double facing_rad) const;
  /// The place stands elsewhere than was configured: moves its plate, and the pose from which the
  /// robot works on it along. @pre index < fire_places.size().
  void movePlace(std::size_t index, const Eigen::Vector3d& p_plate_map, double facing_rad);
  /// Tables and boxes at their configured places, as boxes for planning and drawing.
  [[nodiscard]] std::vector<BoxConfig> fireFurniture() const;
};

}  // namespace kiln
