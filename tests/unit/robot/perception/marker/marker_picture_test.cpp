// The whole way on painted pictures: sun and shadows, exposure, colour cast, noise, JPEG, a slope,
// mountings and odometry that are off, and things of similar colours.
#include <cmath>

#include <gtest/gtest.h>

#include "common/config/resources.h"
#include "common/core/units.h"
#include "robot/evaluation/marker/marker_trial.h"

namespace kiln {
namespace {

struct Outcome {
  MarkerSearch search;
  MarkerTrial::Step last;
  int seen = 0;
};

Outcome look(MarkerCase what, double distance_m, std::uint64_t seed, int pictures) {
  const auto robot = loadResource<RobotGeometry>("robot_model/bob.yaml");
  EXPECT_TRUE(robot) << robot.error().message;
  MarkerTrial trial(drawYard(what, distance_m, seed), *robot, seed);
  const MarkerDetector detector({});
  MarkerLocalizer localizer({});
  Outcome out;
  for (int i = 0; i < pictures; ++i) {
    out.last = trial.at((i + 1.0) / pictures);
    const MarkerView view = detector.detect(out.last.image);
    const auto ray = winnerRay(view, localizer.camera());
    if (!ray) continue;
    const auto& X_base_rgb = out.last.from.X_base_rgb;
    const auto ground = groundAlongRay(out.last.scan_base, X_base_rgb.translation(),
                                       X_base_rgb.linear() * *ray, 20.0, {});
    if (!ground) continue;
    ++out.seen;
    out.last.from.ground = *ground;
    localizer.add(view, out.last.from);
  }
  out.search = localizer.search();
  return out;
}

TEST(MarkerPicture, WholeMarkerIsFoundAtSevenMetres) {
  for (const std::uint64_t seed : {1, 2}) {
    const Outcome out = look(MarkerCase::Whole, 7.0, seed, 5);
    ASSERT_TRUE(out.search.estimate) << seed;
    const Eigen::Vector3d off =
        out.search.estimate->X_base_wall.translation() - out.last.X_base_wall.translation();
    EXPECT_LT(off.head<2>().norm(), 0.3) << seed;
    const double yaw = projectToGround(out.search.estimate->X_base_wall).yaw_rad -
                       projectToGround(out.last.X_base_wall).yaw_rad;
    EXPECT_LT(std::abs(wrapAngle(yaw)), 3.0 * kDeg) << seed;
  }
}

TEST(MarkerPicture, WhatIsNoWholeMarkerGivesNoPose) {
  for (const MarkerCase what :
       {MarkerCase::Absent, MarkerCase::OneLeg, MarkerCase::LegHidden, MarkerCase::CornerHidden,
        MarkerCase::OtherColour, MarkerCase::OneColour, MarkerCase::Small}) {
    const Outcome out = look(what, 6.0, 3, 3);
    EXPECT_FALSE(out.search.estimate) << toString(what);
    EXPECT_FALSE(out.search.refused.empty()) << toString(what);
  }
}

TEST(MarkerPicture, SameSeedPaintsTheSamePicture) {
  const auto robot = loadResource<RobotGeometry>("robot_model/bob.yaml");
  ASSERT_TRUE(robot);
  const MarkerYard yard = drawYard(MarkerCase::Whole, 7.0, 4);
  MarkerTrial a(yard, *robot, 4), b(yard, *robot, 4);
  const auto first = a.at(0.5), again = b.at(0.5);
  EXPECT_EQ(first.image.data, again.image.data);
  EXPECT_EQ(first.scan_base.x, again.scan_base.x);
}

}  // namespace
}  // namespace kiln
