#pragma once

#include <optional>
#include <vector>

#include "common/core/stamp.h"
#include "robot/sim/true_arena.h"

namespace kiln::sim {

/// Heated boards on which an infrared camera sees where cold water landed: a grid of cells on each
/// face, cooled a little by every drop, warm again after some seconds. Water that runs down is not
/// modelled. Confined to the world's thread.
class WetBoards {
 public:
  WetBoards(const std::vector<WarmBoardConfig>& boards, const TrueArena& arena);

  [[nodiscard]] bool empty() const { return boards_.empty(); }
  /// A drop landed. @param box index in TrueArena::boxes; one that is no board is left alone.
  void land(std::size_t box, const Eigen::Vector3d& p_map, Stamp now);
  /// How much cooler that spot is than its board, K.
  [[nodiscard]] double coolness(std::size_t box, const Eigen::Vector3d& p_map, Stamp now) const;

 private:
  struct Cell {
    double coolness_k = 0.0;
    Stamp since;
  };
  struct Board {
    std::size_t box = 0;
    WarmBoardConfig config;
    Eigen::Isometry3d X_board_map = Eigen::Isometry3d::Identity();
    Eigen::Vector3d size_m = Eigen::Vector3d::Ones();
    double water_below_k = 0.0;  ///< the water is cooler than the board by this
    int thin = 0, u = 1, v = 2;  ///< axes: across the board and along its faces
    int columns = 0, rows = 0;
    std::vector<Cell> cells;  ///< two faces, row by row

    [[nodiscard]] double now(const Cell& cell, Stamp at) const;
    [[nodiscard]] const Cell* cell(int face, int column, int row) const;
    [[nodiscard]] int face(const Eigen::Vector3d& p_board) const { return p_board[thin] > 0.0; }
  };
  [[nodiscard]] const Board* find(std::size_t box) const;

  std::vector<Board> boards_;
};

}  // namespace kiln::sim
