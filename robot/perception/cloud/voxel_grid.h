#pragma once

#include "common/model/sensor.h"

namespace kiln {

/// One point a cube of edge `leaf_m`: the mean of the points in it, with the intensity, ring and
/// time of the first. NaN points are dropped. Order: by first appearance, so the result is
/// deterministic.
/// @pre leaf_m > 0; points within +-2^20 leaves of the origin (others are dropped).
[[nodiscard]] PointCloud voxelDownsample(const PointCloud& cloud, double leaf_m);

}  // namespace kiln
