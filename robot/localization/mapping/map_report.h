#pragma once

#include <string>
#include <vector>

#include "robot/localization/mapping/pose_graph.h"
#include "robot/localization/surfel_map.h"

namespace kiln {

/// How good a map is, as far as its own scans can tell.
struct MapReport {
  int scans = 0, keyframes = 0, refused = 0, loops = 0;
  double path_m = 0.0;                        ///< along the keyframes
  EdgeResidual odometry, registration, loop;  ///< after optimisation
  EdgeResidual loop_before;                   ///< what the loops found, before it
  double initial_cost = 0.0, final_cost = 0.0;
  double overlap_min = 0.0, overlap_median = 0.0;  ///< share of a scan that the others explain
  double rms_median_m = 0.0;  ///< of a scan against the others, along the normals
  // Anchor: the map against the configured arena.
  double floor_rms_m = 0.0;  ///< of the floor's surfels about z = 0
  double wall_rms_m = 0.0;   ///< of keyframes against the walls, position
  double wall_rms_deg = 0.0;
  int wall_fixes = 0;  ///< keyframes that saw enough of the walls
  struct Segment {
    std::string name;
    int keyframes = 0;
    std::vector<int> surfels;    ///< planar ones by level
    double wall_coverage = 0.0;  ///< share of the inner wall faces that has surfels (indoor)
  };
  std::vector<Segment> segments;
  std::size_t file_bytes = 0;
};

/// For people.
[[nodiscard]] std::string formatReport(const MapReport& report);

}  // namespace kiln
