#include <cmath>

#include <gtest/gtest.h>

#include "robot/sim/water_jet.h"
#include "tests/unit/robot/sim/test_scene.h"

namespace kiln::sim {
namespace {

struct WaterTest : ::testing::Test {
  /// One litre at full flow from `range_m` before the opening, `height_m` above its centre, raised
  /// by `pitch_rad`.
  double delivered(WaterConfig config, double range_m, double height_m, double pitch_rad,
                   double yaw_rad = 0.0) {
    WaterJet jet(config, world.arena.fire_places, 1);
    const Eigen::Isometry3d X = world.fire().X_map_front *
                                makePose({range_m, 0, height_m}, {0, 0, M_PI + yaw_rad}) *
                                makePose({0, 0, 0}, {0, -pitch_rad, 0});
    for (int i = 0; i < 1000; ++i) {
      jet.emit(i < 500 ? 0.002 : 0.0, 1.0, X, Eigen::Vector3d::Zero());
      jet.step(0.004, world.scene->rays());
    }
    EXPECT_NEAR(jet.emittedLitres(), 1.0, 1e-9);
    EXPECT_TRUE(jet.drops().empty());
    for (std::size_t place = 0; place < world.arena.fire_places.size(); ++place) {
      if (place == world.arena.burning) continue;
      EXPECT_EQ(jet.deliveredLitres()[place], 0.0);
    }
    return jet.deliveredLitres()[world.arena.burning];
  }
  TestScene world;
};

// Level at the exit: 0.9 m at 6 m/s take 0.15 s, in which water falls 9.81 / 2 * 0.15^2 = 0.110 m.
TEST_F(WaterTest, JetSagsElevenCentimetresAtNinety) {
  WaterConfig narrow;
  narrow.spread_rms_deg = 0.0;
  EXPECT_NEAR(delivered(narrow, 0.9, 0.110, 0.0), 1.0, 0.001);
  EXPECT_NEAR(delivered(narrow, 0.9, 0.110 + 0.074, 0.0), 1.0, 0.001);  // the opening is +-7.5 cm
  EXPECT_NEAR(delivered(narrow, 0.9, 0.110 + 0.076, 0.0), 0.0, 0.001);
  EXPECT_NEAR(delivered(narrow, 0.9, 0.110 - 0.076, 0.0), 0.0, 0.001);
}

// Behind the opening the jet falls by another 1.47 / 6 * 0.1 + 0.0014 = 2.6 cm before the plate.
TEST_F(WaterTest, OnlyWhatPassesTheOpeningAndHitsThePlateCounts) {
  WaterConfig narrow;
  narrow.spread_rms_deg = 0.0;
  EXPECT_NEAR(delivered(narrow, 0.9, 0.110 - 0.040, 0.0), 1.0, 0.001);
  EXPECT_NEAR(delivered(narrow, 0.9, 0.110 - 0.060, 0.0), 0.0, 0.001) << "below the plate";
}

// 6 cm to the side and 6 cm above the centre: within the square of 15 cm, without the circle.
TEST_F(WaterTest, TheOpeningIsRound) {
  WaterConfig narrow;
  narrow.spread_rms_deg = 0.0;
  const double aside_rad = std::atan2(0.06, 0.9);
  EXPECT_NEAR(delivered(narrow, 0.9, 0.110 + 0.02, 0.0, aside_rad), 1.0, 0.001);
  EXPECT_NEAR(delivered(narrow, 0.9, 0.110 + 0.06, 0.0, aside_rad), 0.0, 0.001);
}

// Spread 2 deg rms over two axes: 1.41 deg a side = 2.5 cm at the plate, 1.0 m away, where the jet
// passes 2.6 cm below the middle: the lower edge is 2.0 sigma away, the upper one 4.
TEST_F(WaterTest, WellAimedJetGoesInBadlyAimedDoesNot) {
  EXPECT_NEAR(delivered({}, 0.9, 0.110, 0.0), 0.95, 0.02);
  EXPECT_LT(delivered({}, 0.9, 0.110, 0.0, 0.2), 0.05);  // 18 cm to the side: onto the acrylic
  // Aimed at the rim, half of it gets in.
  const double half = delivered({}, 0.9, 0.110 + 0.075, 0.0);
  EXPECT_GT(half, 0.35);
  EXPECT_LT(half, 0.65);
}

TEST_F(WaterTest, WaterFromBehindNeverCounts) {
  EXPECT_EQ(delivered({}, -0.9, 0.110, 0.0, M_PI), 0.0);
}

TEST_F(WaterTest, SlowWaterFallsShort) {
  WaterJet jet({}, world.arena.fire_places, 1);
  const Eigen::Isometry3d X = world.fire().X_map_front * makePose({0.9, 0, 0.11}, {0, 0, M_PI});
  for (int i = 0; i < 1000; ++i) {
    jet.emit(i < 500 ? 0.001 : 0.0, 0.5, X, Eigen::Vector3d::Zero());  // one pump: 3 m/s, sag 44 cm
    jet.step(0.004, world.scene->rays());
  }
  EXPECT_EQ(jet.deliveredLitres()[world.arena.burning], 0.0);
}

}  // namespace
}  // namespace kiln::sim
