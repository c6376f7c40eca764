#include "robot/perception/calibration/board_plane.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "common/core/units.h"
#include "common/geom/pose.h"

namespace kiln {
namespace {

const BoardPrior kPrior{{{1.5, 1.3, 1.1}, Eigen::Vector3d(-0.5, -0.87, 0).normalized(), 0.0, 0}};

/// Points of a board, turned and shifted from where it is expected, and of a wall a metre behind.
StillScan scanOf(double turned_deg, const Eigen::Vector3d& shift, bool with_board) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  std::normal_distribution<double> noise(0.0, 0.01);
  const Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
  const Eigen::Vector3d normal = Eigen::AngleAxisd(turned_deg * kDeg, up) * kPrior.where.normal;
  auto scan = std::make_shared<PointCloud>();
  const auto add = [&](const Eigen::Vector3d& middle) {
    for (int i = 0; i < 2000; ++i) {
      const Eigen::Vector3d p = middle + noise(random) * normal +
                                0.8 * unit(random) * up.cross(normal) + 0.75 * unit(random) * up;
      scan->push(static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z()),
                 50, 3, 0.0F);
    }
  };
  if (with_board) add(kPrior.where.p + shift);
  add(kPrior.where.p + shift - 1.0 * normal);
  return {scan, Eigen::Isometry3d::Identity()};
}

TEST(BoardPlane, FindsABoardThatStandsElsewhere) {
  const std::vector<StillScan> scans{scanOf(4.0, {0.1, -0.15, 0.0}, true)};
  const auto board = findBoard(scans, {}, kPrior);
  ASSERT_TRUE(board.has_value()) << board.error();
  const Eigen::Vector3d normal =
      Eigen::AngleAxisd(4.0 * kDeg, Eigen::Vector3d::UnitZ()) * kPrior.where.normal;
  EXPECT_LT(std::acos(std::min(1.0, board->normal.dot(normal))), 0.1 * kDeg);
  const Eigen::Vector3d off = board->p - (kPrior.where.p + Eigen::Vector3d(0.1, -0.15, 0.0));
  EXPECT_LT(std::abs(normal.dot(off)), 0.002);
  EXPECT_LT(off.norm(), 0.05) << "the middle is known only as well as the ends are seen";
  EXPECT_LT(board->rms_m, 0.013);
}

TEST(BoardPlane, TakesNothingElseForIt) {
  const std::vector<StillScan> without{scanOf(4.0, {0.1, -0.15, 0.0}, false)};
  EXPECT_EQ(findBoard(without, {}, kPrior).error().code, ErrorCode::NotFound);
  EXPECT_EQ(findBoard({}, {}, kPrior).error().code, ErrorCode::NotFound);
  const std::vector<StillScan> turned{scanOf(40.0, {0, 0, 0}, true)};
  EXPECT_EQ(findBoard(turned, {}, kPrior).error().code, ErrorCode::NotFound);
}

}  // namespace
}  // namespace kiln
