#include "robot/localization/posts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <tuple>

namespace kiln {
namespace {

constexpr float kJump_m = 0.4F;         // how far behind the neighbour must lie
constexpr float kJumpOverStep = 4.0F;   // and by how much more than along the surface itself
constexpr float kGapCosine = 0.99939F;  // 2 deg between neighbours: no return in between
constexpr float kMinRange_m = 0.8F, kMaxRange_m = 15.0F;
constexpr int kRings = 16;
constexpr double kCell_m = 0.1;
constexpr double kMerge_m = 0.08;
constexpr double kMinHeight_m = 0.6, kMaxSigma_m = 0.04;
constexpr double kMinPoints = 12.0;

/// The last point of a ring and what is known of its surface.
struct RingState {
  Eigen::Vector3f p = Eigen::Vector3f::Zero(), ray = Eigen::Vector3f::Zero();
  float range = 0.0F, step = 1e9F;
  bool valid = false;
};

std::optional<ScanEdge> edgeAt(const Eigen::Vector3f& p, float range, const Eigen::Vector3f& away) {
  Eigen::Vector3f free(away.x(), away.y(), 0.0F);
  const float norm = free.norm();
  if (range < kMinRange_m || range > kMaxRange_m || norm < 1e-6F) return std::nullopt;
  return ScanEdge{p, free / norm};
}

}  // namespace

std::vector<ScanEdge> findEdges(const PointCloud& scan, const Eigen::Vector3d& p_base_sensor,
                                int max_edges) {
  const Eigen::Vector3f sensor = p_base_sensor.cast<float>();
  std::array<RingState, kRings> rings;
  std::vector<ScanEdge> found;
  const auto keep = [&](const std::optional<ScanEdge>& edge) {
    if (edge) found.push_back(*edge);
  };
  const bool has_rings = scan.ring.size() == scan.size();
  for (std::size_t i = 0; has_rings && i < scan.size(); ++i) {
    const Eigen::Vector3f p(scan.x[i], scan.y[i], scan.z[i]);
    const Eigen::Vector3f d = p - sensor;
    const float range = d.norm();
    if (!(range > 1e-3F) || scan.ring[i] >= kRings) continue;
    RingState& last = rings[scan.ring[i]];
    const Eigen::Vector3f ray = d / range;
    float step = 1e9F;
    if (last.valid) {
      const bool gap = ray.dot(last.ray) < kGapCosine;
      const float jump = range - last.range;
      step = gap ? 1e9F : std::abs(jump);
      if (gap) {
        keep(edgeAt(last.p, last.range, ray - last.ray));
        keep(edgeAt(p, range, last.ray - ray));
      } else if (jump > kJump_m && jump > kJumpOverStep * std::min(last.step, kJump_m)) {
        keep(edgeAt(last.p, last.range, ray - last.ray));
      } else if (-jump > kJump_m) {
        keep(edgeAt(p, range, last.ray - ray));
      }
    }
    last = {p, ray, range, step, true};
  }
  const auto limit = static_cast<std::size_t>(std::max(0, max_edges));
  if (found.size() <= limit) return found;
  std::vector<ScanEdge> out;
  for (std::size_t i = 0; i < limit; ++i) out.push_back(found[i * found.size() / limit]);
  return out;
}

void PostCollector::merge(Cell& into, const Cell& other) {
  into.scans = std::max(into.scans, other.scans);
  into.count += other.count;
  into.squares += other.squares;
  into.sum += other.sum;
  into.free += other.free;
  into.z_min = std::min(into.z_min, other.z_min);
  into.z_max = std::max(into.z_max, other.z_max);
}

void PostCollector::add(std::span<const ScanEdge> edges, const Eigen::Isometry3d& X_map_base) {
  ++scan_;
  for (const ScanEdge& edge : edges) {
    const Eigen::Vector3d p = X_map_base * edge.p.cast<double>();
    const Eigen::Vector2d free = (X_map_base.linear() * edge.free.cast<double>()).head<2>();
    Cell cell{
        static_cast<int>(std::floor(p.x() / kCell_m)),
        static_cast<int>(std::floor(p.y() / kCell_m)),
        std::abs(free.x()) > std::abs(free.y()) ? (free.x() > 0 ? 0 : 1) : (free.y() > 0 ? 2 : 3)};
    const auto at =
        std::lower_bound(cells_.begin(), cells_.end(), cell, [](const Cell& a, const Cell& b) {
          return std::tie(a.x, a.y, a.side) < std::tie(b.x, b.y, b.side);
        });
    const bool known =
        at != cells_.end() && at->x == cell.x && at->y == cell.y && at->side == cell.side;
    Cell& into = known ? *at : *cells_.insert(at, cell);
    if (into.last_scan != scan_) {
      into.last_scan = scan_;
      ++into.scans;
    }
    into.count += 1.0;
    into.sum += p.head<2>();
    into.squares += p.head<2>().squaredNorm();
    into.free += free;
    into.z_min = std::min(into.z_min, p.z());
    into.z_max = std::max(into.z_max, p.z());
  }
}

std::vector<Post> PostCollector::posts(int min_scans) const {
  std::vector<Cell> cells = cells_;
  std::stable_sort(cells.begin(), cells.end(),
                   [](const Cell& a, const Cell& b) { return a.count > b.count; });
  std::vector<Post> out;
  std::vector<bool> taken(cells.size(), false);
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (taken[i] || cells[i].scans < min_scans) continue;
    Cell whole = cells[i];
    const Eigen::Vector2d center = cells[i].sum / cells[i].count;
    for (std::size_t j = i + 1; j < cells.size(); ++j) {
      const bool near = !taken[j] && cells[j].free.dot(cells[i].free) > 0.0 &&
                        (cells[j].sum / cells[j].count - center).norm() < kMerge_m;
      if (!near) continue;
      merge(whole, cells[j]);
      taken[j] = true;
    }
    const Eigen::Vector2d mean = whole.sum / whole.count;
    const double variance = std::max(0.0, 0.5 * (whole.squares / whole.count - mean.squaredNorm()));
    if (whole.count < kMinPoints || whole.z_max - whole.z_min < kMinHeight_m ||
        variance > kMaxSigma_m * kMaxSigma_m || whole.free.norm() < 0.5 * whole.count) {
      continue;
    }
    out.push_back({mean.cast<float>(), whole.free.normalized().cast<float>(),
                   static_cast<float>(variance), static_cast<float>(whole.z_min),
                   static_cast<float>(whole.z_max)});
  }
  return out;
}

}  // namespace kiln
