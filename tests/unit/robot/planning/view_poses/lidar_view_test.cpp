#include "robot/planning/view_poses/lidar_view.h"

#include <gtest/gtest.h>

#include "common/config/resources.h"
#include "common/core/units.h"

namespace kiln {
namespace {

class LidarViewTest : public ::testing::Test {
 protected:
  [[nodiscard]] Result<SweepMotion> motion(const LidarView& view) const {
    return sweepMotion(robot, world, view, home, kDuration_s, {});
  }
  static constexpr double kDuration_s = 4.2;
  RobotGeometry robot = *loadResource<RobotGeometry>("robot_model/mario.yaml");
  ArmCollision world{robot};
  Vector6d home = RobotGeometry::radians(robot.q_drive_deg);
};

TEST_F(LidarViewTest, CarriesTheLidarThroughTheTiltAboutItsCentre) {
  const LidarView view{{0.85, 0.2, 1.5}, 0.1, 8.0 * kDeg, 34.0 * kDeg};
  const auto found = motion(view);
  ASSERT_TRUE(found.has_value()) << found.error();
  const auto poses = lidarPoses(robot, *found, 9);
  ASSERT_EQ(poses.size(), 9U);
  EXPECT_TRUE(poses.front().isApprox(view.X_base_lidar(view.tilt_from_rad), 1e-6));
  EXPECT_TRUE(poses.back().isApprox(view.X_base_lidar(view.tilt_to_rad), 1e-6));
  double before = 0.0;
  for (const Eigen::Isometry3d& X : poses) {
    // Straight in joint space: not quite about its centre in between.
    EXPECT_LT((X.translation() - view.p_base).norm(), 0.04);
    const double down = -std::asin(X.linear()(2, 0));
    EXPECT_GT(down, before);
    before = down;
  }
}

TEST_F(LidarViewTest, SaysWhyNot) {
  const auto far = motion({{2.5, 0.0, 1.5}, 0.0, 0.1, 0.5});
  ASSERT_FALSE(far.has_value());
  EXPECT_EQ(far.error().code, ErrorCode::Degenerate);
  const auto in_deck = motion({{0.75, 0.0, 0.45}, 0.0, 0.1, 0.5});
  ASSERT_FALSE(in_deck.has_value());
  const auto fast = sweepMotion(robot, world, {{0.85, 0.2, 1.5}, 0.1, 0.1, 0.6}, home, 0.3, {});
  ASSERT_FALSE(fast.has_value());
  EXPECT_EQ(fast.error().code, ErrorCode::Refused);
  EXPECT_NE(fast.error().message.find("too fast"), std::string::npos) << fast.error();
}

TEST_F(LidarViewTest, KeepsAwayFromWhatStandsAround) {
  const LidarView view{{0.9, 0.0, 1.4}, 0.0, 0.1, 0.5};
  ASSERT_TRUE(motion(view).has_value());
  BoxConfig box;
  box.name = "crate";
  box.center.xyz_m = {1.05, 0.0, 1.4};
  box.size_m = {0.1, 0.6, 0.6};
  world.setScene({box}, {});
  const auto hindered = motion(view);
  ASSERT_FALSE(hindered.has_value());
  EXPECT_EQ(hindered.error().code, ErrorCode::Refused);
  EXPECT_NE(hindered.error().message.find("too near"), std::string::npos) << hindered.error();
}

TEST_F(LidarViewTest, FirstLookIsFromTheDrivingPosture) {
  for (const char* file : {"robot_model/mario.yaml", "robot_model/bob_wall.yaml"}) {
    const RobotGeometry other = *loadResource<RobotGeometry>(file);
    const Vector6d q = RobotGeometry::radians(other.q_drive_deg);
    const LidarView look = firstLook(other, -4.0 * kDeg, 16.0 * kDeg);
    const auto found = sweepMotion(other, ArmCollision(other), look, q, kDuration_s, {});
    ASSERT_TRUE(found.has_value()) << file << found.error();
    EXPECT_LT((found->q_from - q).cwiseAbs().maxCoeff(), 0.6) << file;
    const Eigen::Isometry3d X = other.X_base_flange(q) * other.X_flange_lidar.pose();
    EXPECT_LT((X.translation() - look.p_base).norm(), 1e-9) << file;
  }
}

}  // namespace
}  // namespace kiln
