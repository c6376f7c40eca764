#include "robot/planning/arm_motion/cartesian_path.h"

#include <cmath>

#include "robot/planning/arm_motion/arm_planner.h"
#include "robot/planning/arm_motion/ur_inverse.h"
#include "tests/unit/robot/planning/arm_motion/bob.h"

namespace kiln {
namespace {

class CartesianPathTest : public ::testing::Test {
 protected:
  Vector6d postureFor(const Eigen::Isometry3d& X_base_flange) {
    const Vector6d home = RobotGeometry::radians(robot.q_drive_deg);
    Vector6d best = home;
    double cost = INFINITY;
    for (const Vector6d& q :
         inverseSolutions(robot.arm, robot.X_base_armbase.pose().inverse() * X_base_flange)) {
      const Vector6d near = nearestTurn(robot.arm, q, home);
      const double d = (near - home).cwiseAbs().maxCoeff();
      if (d < cost && collision.distance(near) > 0.03) {
        cost = d;
        best = near;
      }
    }
    EXPECT_TRUE(std::isfinite(cost));
    return best;
  }

  RobotGeometry robot = loadBob();
  ArenaMap arena = loadKitchen();
  FireSiteMap site = loadKitchenSite();
  ArmCollision collision{robot};
};

/// The search of the fire mission: thermal camera 0.9 m in front of the plate, over +-0.35 m and
/// 0.9 to 1.3 m.
TEST_F(CartesianPathTest, TheWholeSearchRectangleIsOneSmoothLineAtEachFirePlace) {
  for (const FirePlaceConfig& place : site.places) {
    collision.setScene(kitchenBoxes(arena), place.work_pose.pose());
    std::vector<Eigen::Isometry3d> raster;
    double side = -1.0;
    for (double z = 1.3; z > 0.85; z -= 0.1, side = -side) {
      raster.push_back(flangeForCamera(robot, {1.25, side * 0.35, z}));
      raster.push_back(flangeForCamera(robot, {1.25, -side * 0.35, z}));
    }
    const Vector6d q0 = postureFor(raster.front());
    const Vector6d home = RobotGeometry::radians(robot.q_drive_deg);
    EXPECT_TRUE(collision.pathIsFree(home, q0, 0.03)) << place.name;
    raster.erase(raster.begin());
    const auto paths = cartesianPaths(robot, collision, {}, q0, raster, true);
    ASSERT_TRUE(paths.has_value()) << place.name << ": " << paths.error();
    ASSERT_EQ(paths->size(), 1u);
    // 5 x 0.7 m and 4 x 0.1 m less eight rounded corners, and the camera stays in its plane looking
    // ahead.
    EXPECT_NEAR(paths->front().s.back(), 3.9, 0.2);
    EXPECT_LT(paths->front().s.back(), 3.9);
    for (const Vector6d& q : paths->front().q) {
      const Eigen::Isometry3d X = robot.X_base_flange(q) * robot.X_flange_thermal.pose();
      ASSERT_NEAR(X.translation().x(), 1.25, 1e-6);
      ASSERT_GT(X.linear()(0, 2), 1.0 - 1e-9);
    }
  }
}

TEST_F(CartesianPathTest, UnblendedLinesAreStraightAndEndAtEachPose) {
  const std::vector<Eigen::Isometry3d> poses{flangeForCamera(robot, {1.25, 0.2, 1.2}),
                                             flangeForCamera(robot, {1.25, -0.2, 1.0})};
  const Vector6d q0 = postureFor(flangeForCamera(robot, {1.25, 0, 1.1}));
  const auto paths = cartesianPaths(robot, collision, {}, q0, poses, false);
  ASSERT_TRUE(paths.has_value()) << paths.error();
  ASSERT_EQ(paths->size(), 2u);
  const Eigen::Vector3d a = poses[0].translation(), b = poses[1].translation();
  for (const Vector6d& q : (*paths)[1].q) {
    const Eigen::Vector3d p = robot.X_base_flange(q).translation();
    ASSERT_LT((p - a).cross((b - a).normalized()).norm(), 1e-9);
  }
  const Eigen::Isometry3d end = robot.X_base_flange((*paths)[1].q.back());
  EXPECT_LT((end.matrix() - poses[1].matrix()).norm(), 1e-9);
}

TEST_F(CartesianPathTest, BlendedCornersStayWithinTheirRadius) {
  CartesianPathConfig config;
  const Vector6d q0 = postureFor(flangeForCamera(robot, {1.25, 0.2, 1.1}));
  const Eigen::Isometry3d corner = flangeForCamera(robot, {1.25, 0, 1.1});
  const auto paths = cartesianPaths(robot, collision, config, q0,
                                    {corner, flangeForCamera(robot, {1.25, 0, 1.3})}, true);
  ASSERT_TRUE(paths.has_value()) << paths.error();
  double nearest = INFINITY;
  for (const Vector6d& q : paths->front().q) {
    nearest =
        std::min(nearest, (robot.X_base_flange(q).translation() - corner.translation()).norm());
  }
  EXPECT_LT(nearest, config.blend_radius_m);
  EXPECT_GT(nearest, 0.2 * config.blend_radius_m);
}

TEST_F(CartesianPathTest, SaysWhyALineCannotBeFollowed) {
  const Vector6d q0 = postureFor(flangeForCamera(robot, {1.25, 0, 1.1}));
  const auto far =
      cartesianPaths(robot, collision, {}, q0, {flangeForCamera(robot, {2.6, 0, 1.1})}, false);
  ASSERT_FALSE(far.has_value());
  EXPECT_EQ(far.error().code, ErrorCode::Degenerate);
  BoxConfig box;
  box.name = "cupboard";
  box.center.xyz_m = {1.4, 0.35, 1.1};
  box.size_m = {0.3, 0.1, 0.3};
  collision.setScene({box}, Pose2{});
  const auto hit =
      cartesianPaths(robot, collision, {}, q0, {flangeForCamera(robot, {1.25, 0.35, 1.1})}, false);
  ASSERT_FALSE(hit.has_value());
  EXPECT_EQ(hit.error().code, ErrorCode::Refused);
  EXPECT_NE(hit.error().message.find("cupboard"), std::string::npos) << hit.error();
}

TEST_F(CartesianPathTest, AnArmThatIsTooNearMayRetreatButNotComeNearer) {
  const Vector6d q0 = postureFor(flangeForCamera(robot, {1.25, 0, 1.1}));
  BoxConfig box;
  box.name = "box";
  box.center.xyz_m = {1.45, 0, 1.1};  // its face 1 cm inside the head's
  box.size_m = {0.32, 0.3, 0.3};
  collision.setScene({box}, Pose2{});
  ASSERT_LT(collision.distance(q0), 0.02);
  const auto back =
      cartesianPaths(robot, collision, {}, q0, {flangeForCamera(robot, {1.15, 0, 1.1})}, false);
  EXPECT_TRUE(back.has_value()) << back.error();
  const auto ahead =
      cartesianPaths(robot, collision, {}, q0, {flangeForCamera(robot, {1.28, 0, 1.1})}, false);
  EXPECT_FALSE(ahead.has_value());
}

TEST_F(CartesianPathTest, SmallFiguresKeepTheirShapeWhenBlended) {
  // An hourglass of 6 cm, smaller than twice the blend radius.
  const Vector6d q0 = postureFor(flangeForCamera(robot, {1.25, -0.03, 1.07}));
  const auto paths = cartesianPaths(
      robot, collision, {}, q0,
      {flangeForCamera(robot, {1.25, 0.03, 1.07}), flangeForCamera(robot, {1.25, -0.03, 1.13}),
       flangeForCamera(robot, {1.25, 0.03, 1.13})},
      true);
  ASSERT_TRUE(paths.has_value()) << paths.error();
  Eigen::Vector3d low = Eigen::Vector3d::Constant(INFINITY), high = -low;
  for (const Vector6d& q : paths->front().q) {
    const Eigen::Vector3d p =
        (robot.X_base_flange(q) * robot.X_flange_thermal.pose()).translation();
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  EXPECT_GT(high.y() - low.y(), 0.045);
  EXPECT_GT(high.z() - low.z(), 0.055);
}

TEST_F(CartesianPathTest, TheNozzleComesToItsWantedPose) {
  Eigen::Isometry3d X_base_nozzle = Eigen::Isometry3d::Identity();
  X_base_nozzle.linear() = frameFromXAndUp(Eigen::Vector3d(1, 0.1, 0.15), Eigen::Vector3d::UnitZ());
  X_base_nozzle.translation() = Eigen::Vector3d(1.25, 0.1, 1.05);
  const Vector6d q = postureFor(flangeFor(X_base_nozzle, robot.X_flange_nozzle.pose()));
  const Eigen::Isometry3d got = robot.X_base_flange(q) * robot.X_flange_nozzle.pose();
  EXPECT_LT((got.matrix() - X_base_nozzle.matrix()).norm(), 1e-9);
}

}  // namespace
}  // namespace kiln
