#include "robot/perception/cloud/voxel_grid.h"

#include <bit>
#include <cmath>

#include "common/core/check.h"

namespace kiln {
namespace {

constexpr std::uint64_t kEmpty = ~std::uint64_t{0};
constexpr float kHalfExtent = 1 << 20;  // leaves each side: 21 bits an axis

/// Open addressing over 2^k slots, at most half full.
class LeafTable {
 public:
  explicit LeafTable(std::size_t expected)
      : slots_(std::bit_ceil(std::max<std::size_t>(16, 2 * expected)), {kEmpty, 0}) {}
  /// Index stored for `key`, or `fresh` after storing it.
  std::uint32_t find(std::uint64_t key, std::uint32_t fresh) {
    std::size_t i = (key * 0x9E3779B97F4A7C15ull >> 20) & (slots_.size() - 1);
    while (slots_[i].key != key) {
      if (slots_[i].key == kEmpty) {
        slots_[i] = {key, fresh};
        return fresh;
      }
      i = (i + 1) & (slots_.size() - 1);
    }
    return slots_[i].index;
  }

 private:
  struct Slot {
    std::uint64_t key;
    std::uint32_t index;
  };
  std::vector<Slot> slots_;
};

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
