#include "robot/missions/wall/pile_bricks.h"

#include <cmath>

#include <gtest/gtest.h>

#include "common/core/units.h"

namespace kiln {
namespace {

PileBrick at(double x, double y, BrickKind kind = BrickKind::Red) {
  PileBrick out{kind, BrickState::Found, Eigen::Isometry3d::Identity(), 0.95, false, 0.006};
  out.X_map_brick.translation() << x, y, 0.1;
  return out;
}

std::vector<PileBrick> seenFrom(std::vector<PileBrick> bricks, const Pose2& wrong) {
  for (PileBrick& brick : bricks) brick.X_map_brick = toIsometry(wrong) * brick.X_map_brick;
  return bricks;
}

const std::vector<PileBrick> kKnown{at(0, 0), at(1.0, 0), at(1.9, 0, BrickKind::Blue)};

TEST(PileBricks, TheFirstLookIsTakenAsItIs) {
  const auto out = merged({}, kKnown, 0.7);
  ASSERT_EQ(out.size(), 3u);
  EXPECT_DOUBLE_EQ(out[2].X_map_brick.translation().x(), 1.9);
}

TEST(PileBricks, WhatIsNotSeenFollowsTheOthers) {
  const Pose2 wrong{0.05, -0.02, 1.0 * kDeg};
  auto seen = seenFrom(kKnown, wrong);
  const Eigen::Isometry3d true_blue = seen[2].X_map_brick;
  seen[2] = {BrickKind::Blue, BrickState::Unseen, Eigen::Isometry3d::Identity(), 0.0, false};
  const auto out = merged(kKnown, seen, 0.7);
  EXPECT_NEAR((out[2].X_map_brick.translation() - true_blue.translation()).norm(), 0.0, 2e-3);
  EXPECT_GT(out[2].confidence, 0.7);
}

/// From near its ends are not in sight: along its length it is where it was, else as it is seen.
TEST(PileBricks, ALongBrickKeepsItsPlaceAlongItsLengthAlone) {
  auto seen = seenFrom(kKnown, {0.05, 0.0, 0.0});
  seen[2].state = BrickState::Uncertain;
  seen[2].confidence = 0.0;
  seen[2].along_m = 0.15;
  seen[2].X_map_brick.translation() += Eigen::Vector3d(0.04, 0.003, 0.0);
  const auto out = merged(kKnown, seen, 0.7);
  EXPECT_NEAR(out[2].X_map_brick.translation().x(), 1.95, 1e-3);
  EXPECT_NEAR(out[2].X_map_brick.translation().y(), 0.003, 1e-9);
  EXPECT_EQ(out[2].state, BrickState::Found);
  EXPECT_GT(out[2].confidence, 0.7);
}

/// A hundred looks with an error of their own each, from one stand.
TEST(PileBricks, LooksFromOneStandAreAveragedAlongTheLength) {
  std::vector<PileBrick> known = kKnown;
  double worst_m = 0.0;
  for (int look = 0; look < 100; ++look) {
    auto seen = kKnown;
    for (PileBrick& brick : seen) brick.X_map_brick.translation().x() += look % 2 ? 0.012 : -0.012;
    known = merged(known, seen, 0.7, true);
    worst_m = std::max(worst_m, std::abs(known[1].X_map_brick.translation().x() - 1.0));
  }
  EXPECT_LT(worst_m, 0.0065);
  EXPECT_LT(known[1].along_m, 0.004);
}

/// The last one: nothing else says how far the wheels erred.
TEST(PileBricks, ALoneBrickThatIsSeenVaguelyAfterADriveIsKnownLessWell) {
  std::vector<PileBrick> known{kKnown[0]};
  auto seen = known;
  seen[0].state = BrickState::Uncertain;
  seen[0].confidence = 0.3;
  seen[0].along_m = 0.01;
  seen[0].X_map_brick.translation().x() += 0.03;
  const double stood = merged(known, seen, 0.7, true)[0].X_map_brick.translation().x();
  const double drove = merged(known, seen, 0.7, false)[0].X_map_brick.translation().x();
  EXPECT_LT(stood, 0.015);
  EXPECT_GT(drove, 0.025);
}

TEST(PileBricks, WhatLiesElsewhereOrIsGoneIsBelieved) {
  auto seen = kKnown;
  seen[1].state = BrickState::Uncertain;
  seen[1].confidence = 0.1;
  seen[1].X_map_brick.translation().y() += 0.15;
  seen[2].state = BrickState::Missing;
  seen[2].confidence = 0.0;
  const auto out = merged(kKnown, seen, 0.7);
  EXPECT_EQ(out[1].state, BrickState::Uncertain);
  EXPECT_NEAR(out[1].X_map_brick.translation().y(), 0.15, 1e-9);
  EXPECT_EQ(out[2].state, BrickState::Missing);
}

TEST(PileBricks, WhatWasTakenStaysTaken) {
  auto known = kKnown;
  known[0].taken = true;
  auto seen = kKnown;
  seen[0].X_map_brick.translation().x() += 1.0;  // whatever stands there: not this one
  const auto out = merged(known, seen, 0.7);
  EXPECT_TRUE(out[0].taken);
  EXPECT_NEAR(out[1].X_map_brick.translation().x(), 1.0, 1e-9);
}

}  // namespace
}  // namespace kiln
