#include "robot/perception/bricks/pile_detector.h"

#include <gtest/gtest.h>

#include "common/core/units.h"
#include "common/geom/pose.h"
#include "robot/evaluation/bricks/brick_trial.h"

namespace kiln {
namespace {

/// The pile as seen from 6 m before it, with the distractors of scenario.md section 4.
struct Yard {
  BrickScene scene;
  std::vector<ClutterBox> clutter;
  Eigen::Isometry3d X_world_base;
  SearchArea area;

  explicit Yard(std::uint64_t seed, double distance_m = 6.0) {
    SceneRandom random(seed);
    scene = makePileScene(false, random);
    const Eigen::Isometry3d& X = scene.X_world_target;
    X_world_base = X * makePose({1.5, -distance_m, 0}, {0, 0, M_PI_2});
    clutter = {{X * makePose({6.5, 0.5, 0.3}, {0, 0, 0.3}), {0.8, 0.6, 0.6}},   // crate
               {X * makePose({-2.5, 1.0, 0.3}, {0, 0, 0.9}), {0.8, 0.6, 0.6}},  // crate
               {X * makePose({-2.0, -1.5, 0.85}, {0, 0, 0}), {0.4, 0.5, 1.7}},  // person
               {X * makePose({2.0, 6.0, 0.6}, {0, 0, 0}), {20.0, 0.05, 1.2}}};  // fence
    area.X_base_area = X_world_base.inverse() * X * makePose({2.6, 0.3, 0}, {0, 0, 0.1});
    area.half_x_m = 5.0;
    area.half_y_m = 4.5;
    area.x_expected = X_world_base.inverse().linear() * X.linear().col(0);
  }
  [[nodiscard]] Result<PileSearch> detect() const {
    SceneRandom random(7);
    SweepSensor sensor;
    sensor.tilt_from_deg = 0.0;
    sensor.tilt_to_deg = 20.0;
    sensor.sweep_s = 2.0;
    const BrickSweep sweep = SweepSynthesis(sensor, random).sweep(scene, X_world_base, clutter);
    return PileDetector({}).detect(sweep, area, arenaPile());
  }
  [[nodiscard]] Eigen::Isometry3d off(const PileDetection& found) const {
    return (X_world_base.inverse() * scene.X_world_target).inverse() * found.X_base_pile;
  }
};

TEST(PileDetector, FindsThePileAmongDistractors) {
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    const Yard yard(seed);
    const auto search = yard.detect();
    ASSERT_TRUE(search.has_value()) << search.error();
    ASSERT_EQ(search->found.size(), 1U) << search->why;
    const Eigen::Isometry3d off = yard.off(search->found[0]);
    EXPECT_LT(off.translation().norm(), 0.3) << off.translation().transpose();
    EXPECT_LT(rotationAngle(off) / kDeg, 4.0);
    EXPECT_GE(search->candidates.size(), 3U);
    int unrefused = 0;
    for (const PileCandidate& c : search->candidates) unrefused += c.refused.empty() ? 1 : 0;
    EXPECT_EQ(unrefused, 1);
  }
}

TEST(PileDetector, SaysWhyEachOtherClusterIsNotThePile) {
  Yard yard(4);
  yard.scene.bricks.clear();
  const auto search = yard.detect();
  ASSERT_TRUE(search.has_value()) << search.error();
  EXPECT_TRUE(search->found.empty());
  EXPECT_NE(search->why.find("none of"), std::string::npos) << search->why;
  ASSERT_FALSE(search->candidates.empty());
  for (const PileCandidate& c : search->candidates) EXPECT_FALSE(c.refused.empty());
}

TEST(PileDetector, IsNotTakenInByAPileOfOneLayer) {
  Yard yard(5);
  std::erase_if(yard.scene.bricks, [](const TrueBrick& brick) {
    return brick.X_world_brick.translation().z() > 0.15;  // the aerial robots' pile
  });
  const auto search = yard.detect();
  ASSERT_TRUE(search.has_value()) << search.error();
  EXPECT_TRUE(search->found.empty());
}

TEST(PileDetector, LooksNowhereButInItsArea) {
  Yard yard(6);
  yard.area.X_base_area.translation() += Eigen::Vector3d(0, 30, 0);
  const auto search = yard.detect();
  if (search.has_value()) {
    EXPECT_TRUE(search->found.empty());
  } else {
    EXPECT_EQ(search.error().code, ErrorCode::Degenerate);
  }
}

TEST(PileDetector, FindsNothingOnBareGround) {
  Yard yard(7);
  yard.scene.bricks.clear();
  yard.clutter.clear();
  const auto search = yard.detect();
  ASSERT_TRUE(search.has_value()) << search.error();
  EXPECT_TRUE(search->found.empty());
  EXPECT_EQ(search->why, "nothing stands in the search area");
}

TEST(PileDetector, NoPointIsAnError) {
  const auto search = PileDetector({}).detect({}, {}, arenaPile());
  ASSERT_FALSE(search.has_value());
  EXPECT_EQ(search.error().code, ErrorCode::Degenerate);
}

}  // namespace
}  // namespace kiln
