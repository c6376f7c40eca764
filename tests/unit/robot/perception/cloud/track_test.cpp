#include <gtest/gtest.h>

#include "robot/perception/cloud/arm_track.h"
#include "robot/perception/cloud/pose_track.h"

namespace kiln {
namespace {

Stamp at(double s) { return Stamp{fromSeconds(s)}; }

TEST(ArmTrack, InterpolatesAndHoldsAtItsEnds) {
  ArmTrack track;
  EXPECT_FALSE(track.at(at(0)).has_value());
  track.push(at(1), Vector6d::Zero());
  track.push(at(2), Vector6d::Ones());
  EXPECT_NEAR((*track.at(at(1.25)))[3], 0.25, 1e-12);
  EXPECT_NEAR((*track.at(at(0)))[3], 0.0, 1e-12);
  EXPECT_NEAR((*track.at(at(9)))[3], 1.0, 1e-12);
}

TEST(ArmTrack, IgnoresOldAndBrokenSamplesAndForgets) {
  ArmTrack track(std::chrono::seconds(1));
  track.push(at(1), Vector6d::Zero());
  track.push(at(0.5), Vector6d::Ones());
  track.push(at(1.5), Vector6d::Constant(std::nan("")));
  EXPECT_NEAR((*track.at(at(1.5)))[0], 0.0, 1e-12);
  for (int i = 0; i < 1000; ++i) track.push(at(2 + 0.01 * i), Vector6d::Constant(i));
  // 1 s is kept: before that the oldest kept sample (899 or so) is held
  EXPECT_NEAR((*track.at(at(3)))[0], 898.5, 1.5);
}

TEST(PoseTrack, TurnsHalfWayAtHalfTime) {
  PoseTrack track;
  track.push(at(0), Eigen::Isometry3d::Identity());
  track.push(at(1), makePose({2, 0, 0}, {0, 0, 1.0}));
  const Eigen::Isometry3d half = track.at(at(0.5));
  EXPECT_NEAR(half.translation().x(), 1.0, 1e-12);
  EXPECT_NEAR(rotationAngle(half), 0.5, 1e-9);
}

}  // namespace
}  // namespace kiln
