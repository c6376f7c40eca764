#include "robot/localization/surfel_map.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "common/core/check.h"

namespace kiln {
namespace {

constexpr double kSameSurface = 0.3;  // cosine between the views of neighbouring cells

/// Which of the two surfels of a cell a view belongs to: the first one decides.
int sideOf(const std::array<SurfelMoments, 2>& sides, const Eigen::Vector3d& view) {
  if (sides[0].count < 0.5) return sides[1].count > 0.5 && sides[1].view_sum.dot(view) >= 0 ? 1 : 0;
  return sides[0].view_sum.dot(view) >= 0.0 ? 0 : 1;
}

}  // namespace

void SurfelMap::Config::visit(ConfigArchive& a) {
  a.field("finest_cell_m", finest_cell_m, "m", 0.02, 2, "doubled from level to level");
  a.field("levels", levels, "", 1, 6, "of resolution");
  a.field("cells_xy", cells_xy, "", 8, 512, "along X and Y in each level, a multiple of 4");
  a.field("cells_z", cells_z, "", 8, 256, "along Z in each level, a multiple of 4");
}

Result<void> SurfelMap::Config::validate() const {
  if (!(finest_cell_m >= 0.02 && finest_cell_m <= 2.0) || levels < 1 || levels > 6 ||
      cells_xy < 8 || cells_xy > 512 || cells_z < 8 || cells_z > 256 || cells_xy % 4 != 0 ||
      cells_z % 4 != 0) {
    return makeError(ErrorCode::InvalidInput,
                     "surfel map of {} levels with {} x {} x {} cells of {} m: allowed are 1 to 6 "
                     "levels, 8 to 512 (256 along Z) cells in multiples of 4, 0.02 to 2 m",
                     levels, cells_xy, cells_xy, cells_z, finest_cell_m);
  }
  return {};
}

SurfelMap::SurfelMap(const Config& config, const Eigen::Vector3d& p_map_center) : config_(config) {
  KILN_CHECK(config.validate().has_value() && p_map_center.allFinite(), config.levels);
  const double coarsest = config.finest_cell_m * std::pow(2.0, config.levels - 1);
  // Levels nest cell by cell only about a corner of the coarsest lattice.
  const Cell corner = (p_map_center / coarsest).array().round().cast<int>();
  p_map_center_ = corner.cast<double>() * coarsest;
  for (int k = 0; k < config.levels; ++k) {
    Level level;
    level.cell_m = config.finest_cell_m * std::pow(2.0, k);
    const int per_corner = 1 << (config.levels - 1 - k);
    level.first =
        corner * per_corner - Cell(config.cells_xy / 2, config.cells_xy / 2, config.cells_z / 2);
    level.index.assign(static_cast<std::size_t>(config.cells_xy) *
                           static_cast<std::size_t>(config.cells_xy) *
                           static_cast<std::size_t>(config.cells_z),
                       -1);
    levels_.push_back(std::move(level));
  }
}

double SurfelMap::cellSize(int level) const {
  return levels_[static_cast<std::size_t>(level)].cell_m;
}

SurfelMap::Cell SurfelMap::cellOf(const Level& level, const Eigen::Vector3d& p) const {
  return (p / level.cell_m).array().floor().cast<int>();
}

bool SurfelMap::contains(const Level& level, const Cell& cell) const {
  const Cell c = cell - level.first;
  return c.x() >= 0 && c.y() >= 0 && c.z() >= 0 && c.x() < config_.cells_xy &&
         c.y() < config_.cells_xy && c.z() < config_.cells_z;
}

std::size_t SurfelMap::offset(const Level& level, const Cell& cell) const {
  const Cell c = cell - level.first;
  return static_cast<std::size_t>((c.z() * config_.cells_xy + c.y()) * config_.cells_xy + c.x());
}

bool SurfelMap::covers(int level, const Eigen::Vector3d& p_map) const {
  const Level& at = levels_[static_cast<std::size_t>(level)];
  return contains(at, cellOf(at, p_map));
}

bool SurfelMap::coveredByFiner(int level, const Cell& cell) const {
  return level > 0 && contains(levels_[static_cast<std::size_t>(level) - 1], 2 * cell);
}

std::int32_t SurfelMap::voxelAt(Level& level, const Cell& cell) {
  std::int32_t& slot = level.index[offset(level, cell)];
  if (slot < 0) {
    slot = static_cast<std::int32_t>(level.voxels.size());
    Voxel voxel;
    voxel.cell = cell;
    level.voxels.push_back(voxel);
    level.surfels.emplace_back();
  }
  return slot;
}

SurfelMap::ScanId SurfelMap::insert(std::span<const Eigen::Vector3f> points_map,
                                    const Eigen::Vector3d& p_map_sensor) {
  const ScanId id = next_scan_++;
  std::vector<Share>& shares = scans_[id];
  std::unordered_map<std::uint64_t, std::size_t> share_of;
  const Level& coarsest = levels_.back();
  for (const Eigen::Vector3f& point : points_map) {
    if (!point.allFinite()) continue;
    const Eigen::Vector3d p = point.cast<double>();
    const Eigen::Vector3d to_sensor = p_map_sensor - p;
    const double range = to_sensor.norm();
    if (range < 1e-6 || range > 1e4 || !contains(coarsest, cellOf(coarsest, p))) continue;
    const Eigen::Vector3d view = to_sensor / range;
    for (std::size_t k = 0; k < levels_.size(); ++k) {
      const Cell cell = cellOf(levels_[k], p);
      if (!contains(levels_[k], cell)) continue;
      const std::int32_t voxel = voxelAt(levels_[k], cell);
      auto& sides = levels_[k].voxels[static_cast<std::size_t>(voxel)].sides;
      const int side = sideOf(sides, view);
      sides[static_cast<std::size_t>(side)].add(p, view);
      const std::uint64_t key = (static_cast<std::uint64_t>(voxel) << 4U) |
                                static_cast<std::uint64_t>(2 * k + static_cast<std::size_t>(side));
      const auto [at, fresh] = share_of.try_emplace(key, shares.size());
      if (fresh) shares.push_back({static_cast<int>(k), voxel, side, {}});
      shares[at->second].moments.add(p, view);
      break;
    }
  }
  return id;
}

Result<void> SurfelMap::remove(ScanId scan) {
  const auto found = scans_.find(scan);
  if (found == scans_.end()) {
    return makeError(ErrorCode::NotFound,
                     "scan {} is not in the map, or can no longer be taken out", scan);
  }
  for (const Share& share : found->second) {
    SurfelMoments& moments = levels_[static_cast<std::size_t>(share.level)]
                                 .voxels[static_cast<std::size_t>(share.voxel)]
                                 .sides[static_cast<std::size_t>(share.side)];
    moments -= share.moments;
    if (moments.count < 0.5) moments = {};  // no rest of rounding
  }
  scans_.erase(found);
  return {};
}

bool SurfelMap::addMoments(int level, const CellMoments& moments) {
  if (level < 0 || level >= config_.levels) return false;
  Level& at = levels_[static_cast<std::size_t>(level)];
  if (!contains(at, moments.cell) || coveredByFiner(level, moments.cell)) return false;
  auto& sides = at.voxels[static_cast<std::size_t>(voxelAt(at, moments.cell))].sides;
  for (std::size_t s = 0; s < 2; ++s) sides[s] += moments.sides[s];
  return true;
}

void SurfelMap::sumFromFiner(int k) {
  Level& level = levels_[static_cast<std::size_t>(k)];
  for (Voxel& voxel : level.voxels) {
    if (coveredByFiner(k, voxel.cell)) voxel.sides = {};
  }
  for (const Voxel& fine : levels_[static_cast<std::size_t>(k) - 1].voxels) {
    const Cell cell = fine.cell.unaryExpr([](int c) { return c >> 1; });
    for (const SurfelMoments& side : fine.sides) {
      if (side.count < 0.5) continue;
      auto& sides = level.voxels[static_cast<std::size_t>(voxelAt(level, cell))].sides;
      sides[static_cast<std::size_t>(sideOf(sides, side.view_sum))] += side;
    }
  }
}

SurfelMoments SurfelMap::sameSurfaceAround(const Level& level, const Voxel& voxel, int side) const {
  SurfelMoments sum = voxel.sides[static_cast<std::size_t>(side)];
  const Eigen::Vector3d view = sum.view_sum.normalized();
  for (int dz = -1; dz <= 1; ++dz) {
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) {
        const Cell cell = voxel.cell + Cell(dx, dy, dz);
        if ((dx == 0 && dy == 0 && dz == 0) || !contains(level, cell)) continue;
        const std::int32_t slot = level.index[offset(level, cell)];
        if (slot < 0) continue;
        for (const SurfelMoments& other : level.voxels[static_cast<std::size_t>(slot)].sides) {
          if (other.count > 0.5 && other.view_sum.dot(view) > kSameSurface * other.view_sum.norm())
            sum += other;
        }
      }
    }
  }
  return sum;
}

void SurfelMap::refresh() {
  for (int k = 0; k < config_.levels; ++k) {
    if (k > 0) sumFromFiner(k);
    Level& level = levels_[static_cast<std::size_t>(k)];
    for (std::size_t i = 0; i < level.voxels.size(); ++i) {
      const Voxel& voxel = level.voxels[i];
      for (int side = 0; side < 2; ++side) {
        const auto s = static_cast<std::size_t>(side);
        level.surfels[i][s] =
            voxel.sides[s].count < 0.5
                ? Surfel{}
                : makeSurfel(voxel.sides[s], sameSurfaceAround(level, voxel, side), level.cell_m);
      }
    }
  }
}

void SurfelMap::gather(int k, const Eigen::Vector3f& p_map, const Eigen::Vector3f& view,
                       Neighbours& out) const {
  out.size = 0;
  const Level& level = levels_[static_cast<std::size_t>(k)];
  const Eigen::Vector3d scaled = p_map.cast<double>() / level.cell_m;
  const Cell low = (scaled.array() - 0.5).floor().cast<int>() - level.first.array();
  if (low.minCoeff() < 0 || low.x() + 1 >= config_.cells_xy || low.y() + 1 >= config_.cells_xy ||
      low.z() + 1 >= config_.cells_z) {
    return;
  }
  for (int corner = 0; corner < 8; ++corner) {
    const int x = low.x() + (corner & 1), y = low.y() + ((corner >> 1) & 1),
              z = low.z() + (corner >> 2);
    const std::int32_t slot =
        level.index[static_cast<std::size_t>((z * config_.cells_xy + y) * config_.cells_xy + x)];
    if (slot < 0) continue;
    for (const Surfel& surfel : level.surfels[static_cast<std::size_t>(slot)]) {
      if (surfel.planar && surfel.normal.dot(view) > 0.0F)
        out.surfels[static_cast<std::size_t>(out.size++)] = &surfel;
    }
  }
}

std::vector<Surfel> SurfelMap::surfels(int level) const {
  std::vector<Surfel> out;
  for (const auto& sides : levels_[static_cast<std::size_t>(level)].surfels) {
    for (const Surfel& surfel : sides) {
      if (surfel.planar) out.push_back(surfel);
    }
  }
  return out;
}

std::vector<SurfelMap::CellMoments> SurfelMap::ownCells(int level) const {
  std::vector<CellMoments> out;
  for (const Voxel& voxel : levels_[static_cast<std::size_t>(level)].voxels) {
    const auto& sides = voxel.sides;
    if (sides[0].count + sides[1].count > 0.5 && !coveredByFiner(level, voxel.cell))
      out.push_back(voxel);
  }
  return out;
}

double SurfelMap::points() const {
  double sum = 0.0;
  for (const Voxel& voxel : levels_.back().voxels) {
    for (const SurfelMoments& side : voxel.sides) sum += side.count;
  }
  return sum;
}

}  // namespace kiln
