#include "robot/perception/cloud/local_ground.h"

#include <algorithm>
#include <cmath>

#include "common/core/units.h"
#include "common/geom/bearing.h"

namespace kiln {
namespace {

/// Lowest and highest point of a cell, and where the lowest ones lie.
struct Cell {
  float low = INFINITY, high = -INFINITY;
  int points = 0;
};

}  // namespace

void LocalGround::Config::visit(ConfigArchive& a) {
  a.field("sectors", sectors, "", 4, 720, "around the base");
  a.field("ring_m", ring_m, "m", 0.05, 5, "radial length of a cell");
  a.field("max_range_m", max_range_m, "m", 1, 100, "ground farther away is not looked at");
  a.field("max_slope_deg", max_slope_deg, "deg", 1, 45, "steeper is not ground");
  a.field("step_m", step_m, "m", 0, 0.5, "edges and noise");
  a.field("flat_m", flat_m, "m", 0.01, 1, "a higher cell holds more than ground");
  a.field("bump_m", bump_m, "m", 0.02, 2, "above the line to the ground behind: an obstacle");
}

LocalGround::LocalGround(const Config& config, const PointCloud& scan_base) : config_(config) {
  const auto sectors = static_cast<std::size_t>(config.sectors);
  const auto rings = static_cast<std::size_t>(std::ceil(config.max_range_m / config.ring_m));
  std::vector<Cell> cells(sectors * rings);
  for (std::size_t i = 0; i < scan_base.size(); ++i) {
    const float x = scan_base.x[i], y = scan_base.y[i], z = scan_base.z[i];
    const double ring = std::sqrt(double{x} * x + double{y} * y) / config.ring_m;
    if (!(ring < static_cast<double>(rings)) || !std::isfinite(z)) continue;
    Cell& cell = cells[sectorOf(x, y) * rings + static_cast<std::size_t>(ring)];
    cell.low = std::min(cell.low, z);
    cell.high = std::max(cell.high, z);
    ++cell.points;
  }
  profile_.reserve(sectors);
  for (std::size_t s = 0; s < sectors; ++s) {
    std::vector<Node> flat;
    for (std::size_t r = 0; r < rings; ++r) {
      const Cell& cell = cells[s * rings + r];
      if (cell.points < 2 || cell.high - cell.low > config.flat_m) continue;
      flat.push_back(
          {(static_cast<double>(r) + 0.5) * config.ring_m, 0.5 * double{cell.low + cell.high}});
    }
    profile_.push_back(walk(flat));
  }
}

std::size_t LocalGround::sectorOf(double x, double y) const {
  const double share =
      (bearing(static_cast<float>(y), static_cast<float>(x)) + M_PI) / (2.0 * M_PI);
  return std::min(static_cast<std::size_t>(std::max(0.0, share * config_.sectors)),
                  static_cast<std::size_t>(config_.sectors) - 1);
}

std::vector<LocalGround::Node> LocalGround::walk(const std::vector<Node>& cells) const {
  std::vector<Node> out{{0.0, 0.0}};
  const double climb = std::tan(config_.max_slope_deg * kDeg);
  for (const Node& next : cells) {
    // A piece that stands out above the line to what lies behind it is a low thing, not ground.
    while (out.size() > 1) {
      const Node &from = out[out.size() - 2], &bump = out.back();
      const double line =
          from.z_m + (next.z_m - from.z_m) * (bump.r_m - from.r_m) / (next.r_m - from.r_m);
      if (bump.z_m - line <= config_.bump_m) break;
      out.pop_back();
    }
    const Node& last = out.back();
    if (std::abs(next.z_m - last.z_m) <= climb * (next.r_m - last.r_m) + config_.step_m)
      out.push_back(next);
  }
  return out;
}

double LocalGround::groundAt(double x, double y) const {
  const std::vector<Node>& nodes = profile_[sectorOf(x, y)];
  const double r = std::sqrt(x * x + y * y);
  const auto after =
      std::find_if(nodes.begin(), nodes.end(), [r](const Node& node) { return node.r_m >= r; });
  if (after == nodes.begin()) return nodes.front().z_m;
  if (after == nodes.end()) return nodes.back().z_m;
  const Node &a = *(after - 1), &b = *after;
  return a.z_m + (b.z_m - a.z_m) * (r - a.r_m) / (b.r_m - a.r_m);
}

}  // namespace kiln
