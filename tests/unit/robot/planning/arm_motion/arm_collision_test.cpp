#include "robot/planning/arm_motion/arm_collision.h"

#include <algorithm>
#include <cmath>
#include <random>

#include "tests/unit/robot/planning/arm_motion/bob.h"

namespace kiln {
namespace {

TEST(NamedPoses, KeepThreeCentimetresAndCarryTheLidarUpright) {
  const RobotGeometry robot = loadBob();
  const ArmCollision collision(robot);
  for (const auto& q_deg : {robot.q_drive_deg, robot.q_park_deg}) {
    const Vector6d q = RobotGeometry::radians(q_deg);
    const Clearance room = collision.clearance(q);
    EXPECT_GE(room.distance_m, 0.03) << room.what;
    const Eigen::Matrix3d R = robot.X_base_flange(q).linear();
    EXPECT_GT(-R(2, 1), 0.999) << "flange -Y up";
    EXPECT_GT(R(0, 2), 0.98) << "flange Z forward";
  }
  EXPECT_TRUE(collision.pathIsFree(RobotGeometry::radians(robot.q_drive_deg),
                                   RobotGeometry::radians(robot.q_park_deg), 0.03));
}

TEST(NamedPoses, ParkKeepsArmAndHeadWithinTheFootprint) {
  const RobotGeometry robot = loadBob();
  const Vector6d q = RobotGeometry::radians(robot.q_park_deg);
  const Eigen::Isometry3d X_base_flange = robot.X_base_flange(q);
  for (const BoxConfig& box : robot.head) {
    for (int corner = 0; corner < 8; ++corner) {
      const Eigen::Vector3d p((corner & 1 ? 0.5 : -0.5) * box.size_m[0],
                              (corner & 2 ? 0.5 : -0.5) * box.size_m[1],
                              (corner & 4 ? 0.5 : -0.5) * box.size_m[2]);
      const Eigen::Vector3d p_base = X_base_flange * box.center.pose() * p;
      EXPECT_LE(std::abs(p_base.x()), 0.5 * robot.length_m) << box.name;
      EXPECT_LE(std::abs(p_base.y()), 0.5 * robot.width_m) << box.name;
    }
  }
}

TEST(ArmCollision, SeesDeckTanksGroundAndItself) {
  const RobotGeometry robot = loadBob();
  const ArmCollision collision(robot);
  const auto at = [&](std::vector<double> q_deg) {
    return collision.clearance(RobotGeometry::radians(q_deg));
  };
  const Clearance deck = at({180, 0, 60, 0, 90, 0});  // arm stretched back, forearm bent down
  EXPECT_LT(deck.distance_m, 0.0) << deck.what;
  const Clearance folded = at({0, -90, 178, 0, 90, 0});  // forearm on the upper arm
  EXPECT_LT(folded.distance_m, 0.0) << folded.what;
  const Clearance ground = at({0, 35, 10, 0, 0, 0});  // stretched forward and down
  EXPECT_LT(ground.distance_m, 0.0);
  const Clearance up = at({0, -90, 0, -90, 90, 0});
  EXPECT_GT(up.distance_m, 0.0) << up.what;
}

TEST(ArmCollision, TheHoseIsKeptFromWhatStandsBesideTheArm) {
  const RobotGeometry robot = loadBob();
  ArmCollision collision(robot);
  const Vector6d q = RobotGeometry::radians({0, -90, 0, 0, 0, 0});  // upright
  const auto named = [&](const std::string& name) {
    const auto shape = std::find_if(robot.arm_shapes.begin(), robot.arm_shapes.end(),
                                    [&](const ArmShapeConfig& s) { return s.name == name; });
    return collision.shapesAt(q).links.at(
        static_cast<std::size_t>(shape - robot.arm_shapes.begin()));
  };
  const Capsule upper_arm = named("upper arm"), hose = named("hose on upper arm");
  const Eigen::Vector3d beside = hose.a - upper_arm.a;
  EXPECT_NEAR(beside.norm(), upper_arm.radius + 0.001, 1e-9);
  EXPECT_LT((hose.b - upper_arm.b - beside).norm(), 1e-9);
  BoxConfig box;
  box.name = "board";
  const Eigen::Vector3d middle =
      0.5 * (upper_arm.a + upper_arm.b) + (upper_arm.radius + 0.03) * beside.normalized();
  box.center.xyz_m = {middle.x(), middle.y(), middle.z()};
  box.size_m = {0.01, 0.01, 0.01};
  collision.setScene({box}, {});
  EXPECT_LT(collision.clearance(q).distance_m, 0.02) << "25 mm beside the bare link";
  EXPECT_EQ(collision.clearance(q).what, "hose on upper arm to board");
}

// The vendor's model: upper arm 0.1762 m and forearm 0.0393 m beside the Denavit-Hartenberg lines.
TEST(ArmCollision, UpperArmAndForearmStandBesideTheJointsLines) {
  const RobotGeometry robot = loadBob();
  ArmCollision collision(robot);
  const Vector6d q = RobotGeometry::radians({180, 0, 0, 0, 0, 0});  // stretched forward
  const auto roomFor = [&](double along, double aside) {
    BoxConfig pin;
    pin.name = "pin";
    pin.size_m = {0.01, 0.01, 0.01};
    const Eigen::Vector3d p =
        robot.X_base_armbase.pose() * Eigen::Vector3d(along, aside, robot.arm.d[0]);
    pin.center.xyz_m = {p.x(), p.y(), p.z()};
    collision.setScene({pin}, {});
    return collision.clearance(q);
  };
  EXPECT_LT(roomFor(0.3, 0.1762).distance_m, 0.0);
  EXPECT_EQ(roomFor(0.3, 0.1762).what, "upper arm to pin");
  EXPECT_GT(roomFor(0.3, 0.0).distance_m, 0.05) << "beside the line of the joints nothing is";
  EXPECT_LT(roomFor(0.9, 0.0393).distance_m, 0.0);
  EXPECT_EQ(roomFor(0.9, 0.0393).what, "forearm to pin");
}

TEST(ArmCollision, SceneBoxesAreSeenFromTheBase) {
  const RobotGeometry robot = loadBob();
  ArmCollision collision(robot);
  const Vector6d q = RobotGeometry::radians(robot.q_drive_deg);
  const Eigen::Vector3d p_base = robot.X_base_flange(q).translation();
  const Pose2 X_map_base{3.0, -1.0, 2.0};
  BoxConfig box;
  box.name = "crate";
  box.size_m = {0.1, 0.1, 0.1};
  const Eigen::Vector3d p_map = toIsometry(X_map_base) * p_base;
  box.center.xyz_m = {p_map.x(), p_map.y(), p_map.z()};
  collision.setScene({box}, X_map_base);
  const Clearance hit = collision.clearance(q);
  EXPECT_LT(hit.distance_m, 0.0);
  EXPECT_NE(hit.what.find("crate"), std::string::npos) << hit.what;
  collision.setScene({box}, Pose2{0, 0, 0});
  EXPECT_GT(collision.distance(q), 0.03);
}

TEST(ArmCollision, WhatIsCarriedCountsAsAPartOfTheHead) {
  const RobotGeometry robot = loadBob();
  ArmCollision collision(robot);
  const Vector6d q = RobotGeometry::radians(robot.q_drive_deg);
  const Eigen::Isometry3d X_flange_box =
      robot.X_flange_tool.pose() * Eigen::Translation3d(0, 0, 0.1);
  const Eigen::Vector3d size(0.6, 0.2, 0.2);
  const OrientedBox load = makeBox(X_flange_box, size, "load");
  ArmScene scene;
  scene.boxes = {makeBox(robot.X_base_flange(q) * X_flange_box * Eigen::Translation3d(0.36, 0, 0),
                         {0.1, 0.1, 0.1}, "crate")};
  collision.setScene({}, {}, scene);
  EXPECT_GT(collision.distance(q), 0.03) << "beside the bare head there is room";
  const double bound = collision.motionBound(Vector6d::Ones());
  collision.setCarried(load);
  EXPECT_GT(collision.motionBound(Vector6d::Ones()), bound);
  EXPECT_NEAR(collision.clearance(q).distance_m, 0.01, 1e-3);
  EXPECT_EQ(collision.clearance(q).what, "load to crate");
  Vector6d turned = q;
  turned[5] += 1.0;
  EXPECT_FALSE(collision.pathIsFree(q, turned, 0.03));
  EXPECT_EQ(collision.shapesAt(q).head.size(), robot.head.size() + 1);
  collision.setCarried(std::nullopt);
  EXPECT_GT(collision.distance(q), 0.03);
}

TEST(ArmCollision, HeadAndLoadMayTouchWhatIsNamedAndTheArmMayNot) {
  const RobotGeometry robot = loadBob();
  ArmCollision collision(robot);
  const Vector6d q = RobotGeometry::radians(robot.q_drive_deg);
  collision.setCarried(makeBox(robot.X_flange_tool.pose() * Eigen::Translation3d(0, 0, 0.1),
                               {0.3, 0.2, 0.2}, "load"));
  const auto around = [&](const Eigen::Vector3d& p_base, std::vector<std::string> touchable) {
    ArmScene scene;
    scene.boxes = {makeBox(Eigen::Isometry3d(Eigen::Translation3d(p_base)), {0.1, 0.1, 0.1}, "it")};
    scene.touchable = std::move(touchable);
    collision.setScene({}, {}, scene);
    return collision.distance(q);
  };
  const Eigen::Isometry3d X_base_tool = robot.X_base_flange(q) * robot.X_flange_tool.pose();
  const Eigen::Vector3d below = X_base_tool * Eigen::Vector3d(0, 0, 0.24);
  EXPECT_LT(around(below, {}), 0.0);
  EXPECT_GT(around(below, {"it"}), 0.01);
  EXPECT_LT(around(below, {"another"}), 0.0);
  const std::vector<Capsule> links = collision.shapesAt(q).links;
  EXPECT_LT(around(links[4].a, {"it"}), 0.0) << "the forearm touches nothing";
}

TEST(ArmCollision, WhatIsCarriedMayTouchANamedPartOfTheBodyOnThatMotionAlone) {
  RobotGeometry robot = loadBob();
  const Vector6d q = RobotGeometry::radians(robot.q_drive_deg);
  const Eigen::Vector3d below =
      robot.X_base_flange(q) * robot.X_flange_tool.pose() * Eigen::Vector3d(0, 0, 0.24);
  BoxConfig shelf{"shelf", {}, {0.1, 0.1, 0.1}};
  shelf.center.xyz_m = {below.x(), below.y(), below.z()};
  robot.body.push_back(shelf);
  ArmCollision collision(robot);
  collision.setCarried(makeBox(robot.X_flange_tool.pose() * Eigen::Translation3d(0, 0, 0.1),
                               {0.3, 0.2, 0.2}, "load"));
  EXPECT_LT(collision.distance(q), 0.0);
  collision.setScene({}, {}, {{}, {"shelf"}});
  EXPECT_GT(collision.distance(q), 0.01);
  collision.setScene({}, {}, {});
  EXPECT_LT(collision.distance(q), 0.0);
}

TEST(ArmCollision, NoPointMovesFartherThanTheMotionBound) {
  const RobotGeometry robot = loadBob();
  const ArmCollision collision(robot);
  std::mt19937 random(2);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  const Eigen::Vector3d tip(0.10, -0.115, 0.19);  // a corner of the head, in flange
  for (int k = 0; k < 2000; ++k) {
    Vector6d q, dq;
    for (int i = 0; i < 6; ++i) {
      q[i] = M_PI * unit(random);
      dq[i] = 0.3 * unit(random);
    }
    const Eigen::Vector3d before = robot.X_base_flange(q) * tip;
    const Eigen::Vector3d after = robot.X_base_flange(q + dq) * tip;
    ASSERT_LE((after - before).norm(), collision.motionBound(dq) + 1e-9);
    ASSERT_LE(std::abs(collision.distance(q + dq, 5.0) - collision.distance(q, 5.0)),
              collision.motionBound(dq) * 2.0 + 0.05);
  }
}

TEST(ArmCollision, PathCheckFindsWhatFineSamplingFinds) {
  const RobotGeometry robot = loadBob();
  const ArmCollision collision(robot);
  std::mt19937 random(4);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  const Vector6d home = RobotGeometry::radians(robot.q_drive_deg);
  int free = 0, blocked = 0;
  for (int k = 0; k < 200; ++k) {
    Vector6d q = home;
    for (int i = 0; i < 6; ++i) q[i] += 1.2 * unit(random);
    q = q.cwiseMax(-robot.arm.position_limit).cwiseMin(robot.arm.position_limit);
    double least = INFINITY;
    for (int n = 0; n <= 400; ++n) {
      least = std::min(least, collision.distance(home + (q - home) * (n / 400.0)));
    }
    const bool is_free = collision.pathIsFree(home, q, 0.03);
    (is_free ? free : blocked)++;
    if (is_free) {
      ASSERT_GT(least, 0.03 - 0.004);
    } else {
      ASSERT_LT(least, 0.03 + 0.002);
    }
  }
  EXPECT_GT(free, 20);
  EXPECT_GT(blocked, 20);
}

}  // namespace
}  // namespace kiln
