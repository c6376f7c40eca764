#include "robot/sim/wet_boards.h"

#include <algorithm>
#include <cmath>

namespace kiln::sim {

double WetBoards::Board::now(const Cell& cell, Stamp at) const {
  return cell.coolness_k * std::exp(-toSeconds(at - cell.since) / config.warm_again_s);
}

const WetBoards::Cell* WetBoards::Board::cell(int face, int column, int row) const {
  if (column < 0 || row < 0 || column >= columns || row >= rows) return nullptr;
  return &cells[static_cast<std::size_t>((face * rows + row) * columns + column)];
}

WetBoards::WetBoards(const std::vector<WarmBoardConfig>& boards, const TrueArena& arena) {
  for (const WarmBoardConfig& config : boards) {
    const auto box = std::find_if(arena.boxes.begin(), arena.boxes.end(),
                                  [&](const SolidBox& b) { return b.name == config.box; });
    if (box == arena.boxes.end()) continue;  // World::create() has refused it
    Board board;
    board.box = static_cast<std::size_t>(box - arena.boxes.begin());
    board.config = config;
    board.X_board_map = box->X_map_box.inverse();
    board.size_m = box->size_m;
    board.water_below_k = std::max(0.0, box->temperature_c - config.water_c);
    box->size_m.minCoeff(&board.thin);
    board.u = (board.thin + 1) % 3;
    board.v = (board.thin + 2) % 3;
    board.columns = static_cast<int>(std::ceil(board.size_m[board.u] / config.cell_m));
    board.rows = static_cast<int>(std::ceil(board.size_m[board.v] / config.cell_m));
    board.cells.resize(static_cast<std::size_t>(2 * board.columns * board.rows));
    boards_.push_back(std::move(board));
  }
}

const WetBoards::Board* WetBoards::find(std::size_t box) const {
  for (const Board& board : boards_)
    if (board.box == box) return &board;
  return nullptr;
}

void WetBoards::land(std::size_t box, const Eigen::Vector3d& p_map, Stamp now) {
  const Board* const found = find(box);
  if (found == nullptr) return;
  Board& board = boards_[static_cast<std::size_t>(found - boards_.data())];
  const WarmBoardConfig& c = board.config;
  const Eigen::Vector3d p = board.X_board_map * p_map + 0.5 * board.size_m;
  const int face = board.face(p - 0.5 * board.size_m);
  const double u = p[board.u] / c.cell_m - 0.5, v = p[board.v] / c.cell_m - 0.5;  // cells
  const double radius = c.splash_m / c.cell_m;
  for (int row = static_cast<int>(std::ceil(v - radius)); row <= v + radius; ++row) {
    for (int column = static_cast<int>(std::ceil(u - radius)); column <= u + radius; ++column) {
      const Cell* const cell = board.cell(face, column, row);
      if (cell == nullptr || std::hypot(column - u, row - v) > radius) continue;
      const double before = board.now(*cell, now);
      board.cells[static_cast<std::size_t>(cell - board.cells.data())] = {
          before + c.share * (board.water_below_k - before), now};
    }
  }
}

double WetBoards::coolness(std::size_t box, const Eigen::Vector3d& p_map, Stamp now) const {
  const Board* const board = find(box);
  if (board == nullptr) return 0.0;
  const Eigen::Vector3d p = board->X_board_map * p_map;
  const Eigen::Vector3d corner = p + 0.5 * board->size_m;
  const Cell* const cell = board->cell(
      board->face(p), static_cast<int>(std::floor(corner[board->u] / board->config.cell_m)),
      static_cast<int>(std::floor(corner[board->v] / board->config.cell_m)));
  return cell == nullptr ? 0.0 : board->now(*cell, now);
}

}  // namespace kiln::sim
