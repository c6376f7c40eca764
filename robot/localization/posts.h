#pragma once

#include <span>
#include <vector>

#include <Eigen/Geometry>

#include "common/model/sensor.h"

namespace kiln {

/// A point of a scan where a surface ends sideways: its neighbour on the same ring lies far behind
/// or gave no return.
struct ScanEdge {
  Eigen::Vector3f p;     ///< base, metres
  Eigen::Vector3f free;  ///< unit, base, from the surface's end into the open
};

/// Ends of surfaces in a scan: door jambs, corners, legs. At most `max_edges`, spread evenly.
/// @param scan_base      order and rings as the sensor gave them; NaN points are skipped.
/// @param p_base_sensor  where the LiDAR was, base.
[[nodiscard]] std::vector<ScanEdge> findEdges(const PointCloud& scan_base,
                                              const Eigen::Vector3d& p_base_sensor, int max_edges);

/// An upright edge of the building, seen from above. Planes say nothing along a wall; the ends of
/// walls do: from outside it is the door that holds the sideways direction.
struct Post {
  Eigen::Vector2f p = Eigen::Vector2f::Zero();     ///< map, metres
  Eigen::Vector2f free = Eigen::Vector2f::Zero();  ///< unit, into the open
  float variance = 0.0F;                           ///< of its points about `p`, per axis, m^2
  float z_min = 0.0F, z_max = 0.0F;                ///< metres, map
};

/// Collects the edges of many scans; what stands in one place and is tall is a post. Thread-
/// compatible.
class PostCollector {
 public:
  /// Edges of one scan.
  void add(std::span<const ScanEdge> edges, const Eigen::Isometry3d& X_map_base);
  /// Seen in at least `min_scans` scans, 0.6 m tall, less than 4 cm (1-sigma) thick. Deterministic.
  [[nodiscard]] std::vector<Post> posts(int min_scans = 3) const;

 private:
  struct Cell {
    int x, y, side;  ///< 0.1 m cells; which quarter the open lies in
    int scans = 0, last_scan = -1;
    double count = 0.0, squares = 0.0;
    Eigen::Vector2d sum = Eigen::Vector2d::Zero(), free = Eigen::Vector2d::Zero();
    double z_min = 1e9, z_max = -1e9;
  };
  static void merge(Cell& into, const Cell& other);
  std::vector<Cell> cells_;  ///< sorted by (x, y, side)
  int scan_ = 0;
};

}  // namespace kiln
