#include "robot/sim/wet_boards.h"

#include <gtest/gtest.h>

namespace kiln::sim {
namespace {

constexpr std::size_t kBoard = 1;

/// A board across X, 2 cm thick, behind a wall that is none.
TrueArena arenaWithBoard() {
  TrueArena arena;
  arena.boxes.push_back({"wall", Material::Wall, makePose({5, 0, 1}, {0, 0, 0}), {0.2, 4, 2}});
  arena.boxes.push_back({"board", Material::Wall, makePose({2, 0, 1}, {0, 0, 0}), {0.02, 1, 1}});
  arena.boxes.back().temperature_c = 45.0;
  return arena;
}

WarmBoardConfig config() {
  WarmBoardConfig out;
  out.box = "board";
  out.water_c = 15.0;
  out.share = 0.1;
  return out;
}

// 10 % of 45 - 15 degrees a drop: 3 K; 1 - 0.9^2 = 19 % after two.
TEST(WetBoards, EachDropCoolsItsSpotAndTheBoardWarmsAgain) {
  const TrueArena arena = arenaWithBoard();
  WetBoards wet({config()}, arena);
  const Eigen::Vector3d hit(1.99, 0.1, 1.2);
  const Stamp t0{fromSeconds(1.0)}, later{fromSeconds(1.0 + config().warm_again_s)};
  EXPECT_EQ(wet.coolness(kBoard, hit, t0), 0.0);
  wet.land(kBoard, hit, t0);
  EXPECT_NEAR(wet.coolness(kBoard, hit, t0), 3.0, 1e-9);
  wet.land(kBoard, hit, t0);
  EXPECT_NEAR(wet.coolness(kBoard, hit, t0), 5.7, 1e-9);
  EXPECT_NEAR(wet.coolness(kBoard, hit, later), 5.7 / M_E, 1e-9);
  EXPECT_EQ(wet.coolness(kBoard, {1.99, 0.1, 1.22}, t0), 0.0) << "beyond the splash";
  EXPECT_EQ(wet.coolness(kBoard, {2.01, 0.1, 1.2}, t0), 0.0) << "the other face";
}

TEST(WetBoards, NothingElseGetsWet) {
  const TrueArena arena = arenaWithBoard();
  WetBoards wet({config()}, arena);
  const Stamp t{fromSeconds(1.0)};
  wet.land(0, {4.9, 0, 1}, t);
  EXPECT_EQ(wet.coolness(0, {4.9, 0, 1}, t), 0.0);
  wet.land(kBoard, {1.99, 0.5, 1.5}, t);  // a corner: most of the splash misses the board
  EXPECT_GT(wet.coolness(kBoard, {1.99, 0.498, 1.498}, t), 0.0);
  EXPECT_EQ(wet.coolness(kBoard, {1.99, 0.51, 1.5}, t), 0.0);
  EXPECT_TRUE(WetBoards({}, arena).empty());
}

}  // namespace
}  // namespace kiln::sim
