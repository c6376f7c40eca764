#include "robot/perception/cloud/voxel_grid.h"

#include <cmath>

#include "common/core/check.h"
#include "robot/perception/cloud/leaf_table.h"

namespace kiln {
namespace {

constexpr float kHalfExtent = 1 << 20;  // leaves each side: 21 bits an axis

}  // namespace

PointCloud voxelDownsample(const PointCloud& cloud, double leaf_m) {
  KILN_CHECK(leaf_m > 0, leaf_m);
  PointCloud out;
  out.stamp = cloud.stamp;
  out.seq = cloud.seq;
  out.frame = cloud.frame;
  std::vector<std::uint32_t> counts;
  LeafTable table(cloud.size());
  const float per_m = static_cast<float>(1.0 / leaf_m);
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const float lx = std::floor(cloud.x[i] * per_m), ly = std::floor(cloud.y[i] * per_m),
                lz = std::floor(cloud.z[i] * per_m);
    if (!(std::abs(lx) < kHalfExtent && std::abs(ly) < kHalfExtent && std::abs(lz) < kHalfExtent))
      continue;
    const auto bits = [](float leaf) { return static_cast<std::uint64_t>(leaf + kHalfExtent); };
    const std::uint64_t key = bits(lx) << 42 | bits(ly) << 21 | bits(lz);
    const std::uint32_t index = table.find(key, static_cast<std::uint32_t>(counts.size()));
    if (index == counts.size()) {
      counts.push_back(1);
      out.push(cloud.x[i], cloud.y[i], cloud.z[i], cloud.intensity[i], cloud.ring[i],
               cloud.time_offset_s[i]);
      continue;
    }
    const float n = static_cast<float>(++counts[index]);
    out.x[index] += (cloud.x[i] - out.x[index]) / n;
    out.y[index] += (cloud.y[i] - out.y[index]) / n;
    out.z[index] += (cloud.z[i] - out.z[index]) / n;
  }
  return out;
}

}  // namespace kiln
