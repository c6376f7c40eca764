#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "common/config/config_archive.h"
#include "robot/localization/posts.h"
#include "robot/localization/surfel.h"

namespace kiln {

/// Multi-resolution surfel map: nested dense grids about one centre, each with the same number of
/// cells and twice the cell of the next finer one, so that the map is fine where it is centred and
/// still reaches far (Droeschel and Behnke, "Efficient continuous-time SLAM for 3D lidar-based
/// online mapping", ICRA 2018; NimbRo UGV paper, "Laser Navigation").
///
/// A cell holds up to two surfels, told apart by the side they were seen from, so that the inside
/// and the outside of a thin wall never mix. Points go into the finest level that covers them;
/// refresh() sums the coarser levels from it and derives the planes. Thread-compatible; const calls
/// from several threads are safe.
class SurfelMap {
 public:
  struct Config {
    double finest_cell_m = 0.1;  ///< doubled from level to level
    int levels = 4;
    int cells_xy = 128;  ///< along X and Y, each level; a multiple of 4
    int cells_z = 48;    ///< along Z; a multiple of 4
    void visit(ConfigArchive& a);
    [[nodiscard]] Result<void> validate() const;
  };
  using Cell = Eigen::Vector3i;  ///< floor(p / cell size) of its level
  struct CellMoments {
    Cell cell;
    std::array<SurfelMoments, 2> sides;
  };
  using ScanId = std::uint64_t;

  /// @param p_map_center  metres in map; moved to the nearest corner of a coarsest cell.
  /// @pre config.validate() succeeds.
  SurfelMap(const Config& config, const Eigen::Vector3d& p_map_center);

  /// Adds a scan; refresh() makes it count. Points outside the coarsest level or not finite are
  /// left out.
  ScanId insert(std::span<const Eigen::Vector3f> points_map, const Eigen::Vector3d& p_map_sensor);
  /// Takes a scan out again, exactly. Error: NotFound if it was never put in, was taken out, or if
  /// the map has been loaded from a file (which keeps no scans).
  [[nodiscard]] Result<void> remove(ScanId scan);
  /// Forgets which points came from which scan: they can no longer be removed.
  void forgetScans() { scans_.clear(); }
  /// Adds stored sums to a cell of a level (loading).
  /// @return false if the cell is outside the level or covered by a finer one.
  [[nodiscard]] bool addMoments(int level, const CellMoments& moments);
  /// Coarser levels and planes from the sums; about 30 ms for 40,000 surfels.
  void refresh();

  /// Upright edges that hold the directions in which planes say nothing.
  void setPosts(std::vector<Post> posts) { posts_ = std::move(posts); }
  [[nodiscard]] const std::vector<Post>& posts() const { return posts_; }

  struct Neighbours {
    std::array<const Surfel*, 16> surfels;
    int size = 0;
  };
  /// Planar surfels in the eight cells of `level` nearest to `p_map` that face `view`.
  void gather(int level, const Eigen::Vector3f& p_map, const Eigen::Vector3f& view,
              Neighbours& out) const;
  /// Planar surfels of one level, map frame.
  [[nodiscard]] std::vector<Surfel> surfels(int level) const;
  /// Cells of a level that hold points of their own: not those summed from a finer level.
  [[nodiscard]] std::vector<CellMoments> ownCells(int level) const;
  [[nodiscard]] bool covers(int level, const Eigen::Vector3d& p_map) const;
  [[nodiscard]] double cellSize(int level) const;  ///< metres
  [[nodiscard]] const Config& config() const { return config_; }
  [[nodiscard]] const Eigen::Vector3d& center() const { return p_map_center_; }
  [[nodiscard]] double points() const;  ///< all that were put in

 private:
  using Voxel = CellMoments;
  struct Level {
    double cell_m = 0.0;
    Cell first = Cell::Zero();
    std::vector<std::int32_t> index;  ///< dense; -1 = empty
    std::vector<Voxel> voxels;
    /// Of the voxels, as of refresh(). Apart from the sums, which are four times as large: gather()
    /// is bound by memory.
    std::vector<std::array<Surfel, 2>> surfels;
  };
  struct Share {  ///< what one scan gave to one surfel
    int level;
    std::int32_t voxel;
    int side;
    SurfelMoments moments;
  };
  [[nodiscard]] Cell cellOf(const Level& level, const Eigen::Vector3d& p) const;
  [[nodiscard]] bool contains(const Level& level, const Cell& cell) const;
  [[nodiscard]] std::size_t offset(const Level& level, const Cell& cell) const;
  [[nodiscard]] bool coveredByFiner(int level, const Cell& cell) const;
  [[nodiscard]] std::int32_t voxelAt(Level& level, const Cell& cell);
  [[nodiscard]] SurfelMoments sameSurfaceAround(const Level& level, const Voxel& voxel,
                                                int side) const;
  void sumFromFiner(int level);

  Config config_;
  Eigen::Vector3d p_map_center_;
  std::vector<Level> levels_;
  std::vector<Post> posts_;
  std::map<ScanId, std::vector<Share>> scans_;
  ScanId next_scan_ = 1;
};

}  // namespace kiln
