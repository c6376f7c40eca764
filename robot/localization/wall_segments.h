#pragma once

#include <vector>

#include <Eigen/Core>

#include "common/geom/pose.h"
#include "robot/scene/arena_map.h"

namespace kiln {

/// One vertical face of a wall box seen from above: a segment in `map` with the height range it
/// covers.
struct WallSegment {
  Eigen::Vector2d start;      ///< metres, map
  Eigen::Vector2d direction;  ///< unit, from start to end
  Eigen::Vector2d normal;     ///< unit, out of the wall
  double length_m = 0.0;
  double z_min_m = 0.0, z_max_m = 0.0;
};

/// Where a point lies relative to the nearest wall face.
struct WallMatch {
  double distance_m = 0.0;                              ///< signed along `direction`
  Eigen::Vector2d direction = Eigen::Vector2d::Zero();  ///< unit gradient of the distance, map
  bool on_edge = false;  ///< the nearest point is the end of a face (a door jamb, a corner)
};

/// The vertical faces of upright boxes; boxes tilted by more than 1 deg are left out.
[[nodiscard]] std::vector<WallSegment> wallSegments(const std::vector<BoxConfig>& boxes);

/// Those whose outer side is turned to a sensor at `p_map_sensor`: a thin wall is then never
/// matched from behind.
[[nodiscard]] std::vector<WallSegment> facing(const std::vector<WallSegment>& segments,
                                              const Eigen::Vector2d& p_map_sensor);

/// Nearest face to a point within `gate_m`; false when there is none.
[[nodiscard]] bool nearestWall(const std::vector<WallSegment>& segments,
                               const Eigen::Vector3d& p_map, double gate_m, WallMatch& match);

}  // namespace kiln
