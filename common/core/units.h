#pragma once

#include <cmath>

namespace kiln {

/// One degree in radians: `30 * kDeg`, `yaw_rad / kDeg`.
inline constexpr double kDeg = M_PI / 180.0;

}  // namespace kiln
