#include "robot/perception/cloud/range_bias.h"

#include <cmath>

namespace kiln {

void correctRanges(PointCloud& scan, std::span<const double> bias_m) {
  for (std::size_t i = 0; i < scan.size() && !bias_m.empty(); ++i) {
    if (scan.ring[i] >= bias_m.size()) continue;
    const float range =
        std::sqrt(scan.x[i] * scan.x[i] + scan.y[i] * scan.y[i] + scan.z[i] * scan.z[i]);
    if (!(range > 0.0f)) continue;
    const float scale = 1.0f - static_cast<float>(bias_m[scan.ring[i]]) / range;
    scan.x[i] *= scale;
    scan.y[i] *= scale;
    scan.z[i] *= scale;
  }
}

}  // namespace kiln
