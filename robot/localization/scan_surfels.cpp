#include "robot/localization/scan_surfels.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include <Eigen/Eigenvalues>

namespace kiln {
namespace {

/// Sums relative to the first point, so that floats keep their precision.
struct Patch {
  std::uint64_t key = 0;
  Eigen::Vector3f first = Eigen::Vector3f::Zero(), sum = Eigen::Vector3f::Zero();
  Eigen::Matrix3f squares = Eigen::Matrix3f::Zero();
  float count = 0.0F;
};

std::uint64_t cellKey(const Eigen::Vector3f& p, float inverse_cell) {
  const auto part = [&](float v) {
    return static_cast<std::uint64_t>(static_cast<std::int64_t>(std::floor(v * inverse_cell)) +
                                      (1 << 20));
  };
  return (part(p.x()) << 42U) | (part(p.y()) << 21U) | part(p.z());
}

/// Open addressing: cells of one scan in the order in which they were first met.
class PatchTable {
 public:
  explicit PatchTable(std::size_t points) {
    std::size_t slots = 1024;
    while (slots < 2 * points) slots *= 2;
    slots_.assign(slots, -1);
    patches_.reserve(points / 4 + 16);
  }
  Patch& at(std::uint64_t key, const Eigen::Vector3f& first) {
    std::size_t slot = (key * 0x9e3779b97f4a7c15ULL >> 20U) & (slots_.size() - 1);
    while (slots_[slot] >= 0 && patches_[static_cast<std::size_t>(slots_[slot])].key != key)
      slot = (slot + 1) & (slots_.size() - 1);
    if (slots_[slot] < 0) {
      slots_[slot] = static_cast<std::int32_t>(patches_.size());
      patches_.emplace_back();
      patches_.back().key = key;
      patches_.back().first = first;
    }
    return patches_[static_cast<std::size_t>(slots_[slot])];
  }
  [[nodiscard]] const std::vector<Patch>& patches() const { return patches_; }

 private:
  std::vector<std::int32_t> slots_;
  std::vector<Patch> patches_;
};

bool isFlat(const Patch& patch, const Eigen::Vector3f& offset, double max_thickness_m) {
  if (patch.count < 4.0F) return true;
  const Eigen::Matrix3f covariance = patch.squares / patch.count - offset * offset.transpose();
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3f> solver;
  solver.computeDirect(covariance, Eigen::EigenvaluesOnly);
  return static_cast<double>(solver.eigenvalues()[0]) < max_thickness_m * max_thickness_m;
}

}  // namespace

std::vector<ScanSurfel> reduceScan(const PointCloud& scan, const Eigen::Vector3d& p_base_sensor,
                                   const ScanReduction& reduction) {
  const Eigen::Vector3f sensor = p_base_sensor.cast<float>();
  const auto near2 = static_cast<float>(reduction.min_range_m * reduction.min_range_m);
  const auto far2 = static_cast<float>(reduction.max_range_m * reduction.max_range_m);
  const auto inverse_cell = static_cast<float>(1.0 / reduction.cell_m);
  PatchTable table(scan.size());
  for (std::size_t i = 0; i < scan.size(); ++i) {
    const Eigen::Vector3f p(scan.x[i], scan.y[i], scan.z[i]);
    const float range2 = (p - sensor).squaredNorm();
    if (!(range2 > near2 && range2 < far2)) continue;  // NaN too
    Patch& patch = table.at(cellKey(p, inverse_cell), p);
    const Eigen::Vector3f d = p - patch.first;
    patch.count += 1.0F;
    patch.sum += d;
    patch.squares += d * d.transpose();
  }
  std::vector<ScanSurfel> out;
  out.reserve(table.patches().size());
  for (const Patch& patch : table.patches()) {
    const Eigen::Vector3f offset = patch.sum / patch.count;
    if (!isFlat(patch, offset, reduction.max_thickness_m)) continue;
    const Eigen::Vector3f mean = patch.first + offset;
    out.push_back(
        {mean, (sensor - mean).normalized(), std::min(1.0F, 0.25F + 0.25F * patch.count)});
  }
  const auto limit = static_cast<std::size_t>(std::max(1, reduction.max_surfels));
  if (out.size() > limit) {
    std::vector<ScanSurfel> thinned;
    thinned.reserve(limit);
    for (std::size_t i = 0; i < limit; ++i) thinned.push_back(out[i * out.size() / limit]);
    out = std::move(thinned);
  }
  return out;
}

}  // namespace kiln
