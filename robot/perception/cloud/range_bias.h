#pragma once

#include <span>

#include "common/model/sensor.h"

namespace kiln {

/// Takes each laser's calibrated range bias off its points: p * (r - bias) / r.
/// @param scan    in `lidar` (the ranges are from its origin); NaN points stay NaN.
/// @param bias_m  measured minus true range by ring; rings beyond its end are left as they are.
void correctRanges(PointCloud& scan, std::span<const double> bias_m);

}  // namespace kiln
