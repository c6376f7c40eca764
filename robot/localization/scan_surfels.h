#pragma once

#include <vector>

#include <Eigen/Core>

#include "common/model/sensor.h"

namespace kiln {

/// A patch of a scan: the mean of the points in one cell.
struct ScanSurfel {
  Eigen::Vector3f mean;  ///< base, metres
  Eigen::Vector3f view;  ///< unit, from the patch to the sensor, base
  float weight;          ///< 0..1; few points count less
};

struct ScanReduction {
  double cell_m = 0.2;
  double min_range_m = 0.7;  ///< from the sensor
  double max_range_m = 40.0;
  double max_thickness_m = 0.03;  ///< 1-sigma; patches around corners and in bushes are left out
  int max_surfels = 1600;
};

/// Thins a scan to patches of about equal area, so that near walls do not outvote far ones and
/// noise averages out. NaN points are skipped. Deterministic. About 0.8 ms for 27,000 points.
/// @param p_base_sensor  where the LiDAR was, base.
[[nodiscard]] std::vector<ScanSurfel> reduceScan(const PointCloud& scan_base,
                                                 const Eigen::Vector3d& p_base_sensor,
                                                 const ScanReduction& reduction);

}  // namespace kiln
