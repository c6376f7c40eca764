#include "robot/skills/move_arm.h"

#include <cmath>

#include "tests/support/fake_devices.h"
#include "tests/unit/robot/planning/arm_motion/bob.h"
#include "tests/unit/robot/skills/fake_surroundings.h"

namespace kiln {
namespace {

using std::chrono::milliseconds;
constexpr Duration kTick = milliseconds(4);

class MoveArmTest : public ::testing::Test {
 protected:
  MoveArmTest() {
    for (int k = 0; k < 10; ++k) tick();
  }
  void tick() {
    clock.advanceBy(kTick);
    ++ticks;
    arm.advance();
    if (ticks % 2 == 0) controller.tick(clock.now());
    if (ticks % 5 == 0 && polling) status = active->poll(clock.now());
  }
  SkillStatus run(double limit_s = 60.0) {
    polling = true;
    status = active->poll(clock.now());
    const Stamp end = clock.now() + fromSeconds(limit_s);
    while (status.phase == SkillPhase::Running && clock.now() < end) tick();
    polling = false;
    return status;
  }
  void advance(double seconds) {
    const Stamp end = clock.now() + fromSeconds(seconds);
    while (clock.now() < end) tick();
  }
  /// Leaves for the park pose and runs into something on the way.
  void meetSomething() {
    skill.startJoints(RobotGeometry::radians(robot.q_park_deg), clock.now());
    polling = true;
    advance(1.0);
    arm.setForce({0, 0, 90});
    advance(0.3);
    ASSERT_EQ(status.failure_code, "contact") << status.text;
  }
  static MoveArm::Config slowly() {
    MoveArm::Config config;
    config.speed_scale = 0.05;
    return config;
  }
  Vector6d home() const { return RobotGeometry::radians(robot.q_drive_deg); }

  ManualClock clock{Stamp{std::chrono::seconds(10)}};
  RobotGeometry robot = loadBob();
  ArenaMap arena = loadKitchen();
  Pose2 X_map_base = loadKitchenSite().places[0].work_pose.pose();
  FakeArm arm{clock, robot, RobotGeometry::radians(robot.q_drive_deg)};
  StopLatch stop;
  ArmController controller{{}, robot, arm, stop};
  MoveArm skill{{}, robot, arena, controller, arm, [this] { return X_map_base; }};
  MoveArm slow{slowly(), robot, arena, controller, arm, [this] { return X_map_base; }};
  MoveArm* active = &skill;
  SkillStatus status;
  bool polling = false;
  int ticks = 0;
};

TEST_F(MoveArmTest, MovesToAJointGoalWithinTheLimits) {
  const Vector6d park = RobotGeometry::radians(robot.q_park_deg);
  const std::size_t from = arm.sent().size();
  skill.startJoints(park, clock.now());
  run();
  ASSERT_EQ(status.phase, SkillPhase::Done) << status.failure_code << ": " << status.text;
  EXPECT_LT((arm.state()->q - park).cwiseAbs().maxCoeff(), 0.5 * M_PI / 180);
  const auto sent = arm.sent();
  const double dt = toSeconds(2 * kTick);
  for (std::size_t k = from + 1; k < sent.size(); ++k) {
    const Vector6d v = (sent[k].q - sent[k - 1].q) / dt;
    ASSERT_TRUE((v.cwiseAbs().array() <= 0.32 * robot.arm.velocity_limit.array()).all());
  }
}

TEST_F(MoveArmTest, TimedMoveLastsAsLongAsWanted) {
  Vector6d q = home();
  q[3] -= 0.4;
  const Stamp begin = clock.now();
  skill.startTimed(q, 4.2, clock.now());
  ASSERT_EQ(run().phase, SkillPhase::Done) << status.failure_code << ": " << status.text;
  EXPECT_GT(toSeconds(clock.now() - begin), 4.15);
  EXPECT_LT(toSeconds(clock.now() - begin), 5.0);  // to come to rest at either end
  EXPECT_LT((arm.state()->q - q).cwiseAbs().maxCoeff(), 0.5 * M_PI / 180);
  q[2] = NAN;
  skill.startTimed(q, 4.2, clock.now());
  EXPECT_EQ(run().failure_code, "unreachable");
}

/// What looks around meanwhile would have a gap: an ordinary move is taken up again, this is not.
TEST_F(MoveArmTest, TimedMoveEndsWithAnInterruption) {
  Vector6d q = home();
  q[3] -= 0.4;
  skill.startTimed(q, 4.2, clock.now());
  polling = true;
  status = active->poll(clock.now());
  advance(1.5);
  polling = false;
  advance(0.5);
  polling = true;
  advance(0.1);
  EXPECT_EQ(status.failure_code, "tracking") << status.text;
  advance(0.5);
  EXPECT_EQ(status.phase, SkillPhase::Failed);
}

TEST_F(MoveArmTest, SearchesTheWholeRectangleInFrontOfThePlate) {
  skill.startPose(flangeForCamera(robot, {1.25, 0.35, 1.3}), clock.now());
  ASSERT_EQ(run().phase, SkillPhase::Done) << status.failure_code << ": " << status.text;
  std::vector<Eigen::Isometry3d> raster;
  double side = 1.0;
  for (double z = 1.3; z > 0.85; z -= 0.1, side = -side) {
    raster.push_back(flangeForCamera(robot, {1.25, side * 0.35, z}));
    raster.push_back(flangeForCamera(robot, {1.25, -side * 0.35, z}));
  }
  const Stamp begin = clock.now();
  skill.startCartesian(raster, true, clock.now());
  ASSERT_EQ(run().phase, SkillPhase::Done) << status.failure_code << ": " << status.text;
  EXPECT_LT(toSeconds(clock.now() - begin), 30.0);  // 3.9 m at up to 0.25 m/s
  const Eigen::Isometry3d X = robot.X_base_flange(arm.state()->q) * robot.X_flange_thermal.pose();
  EXPECT_NEAR(X.translation().z(), 0.9, 0.01);
  EXPECT_NEAR(X.translation().x(), 1.25, 0.01);
}

TEST_F(MoveArmTest, SaysWhyAGoalIsRefused) {
  skill.startPose(flangeForCamera(robot, {3.0, 0, 1.0}), clock.now());
  EXPECT_EQ(run().failure_code, "unreachable");
  Vector6d q = home();
  q[2] = 4.0;
  skill.startJoints(q, clock.now());
  EXPECT_EQ(run().failure_code, "unreachable");
  q[2] = NAN;
  skill.startJoints(q, clock.now());
  EXPECT_EQ(run().failure_code, "unreachable");
  skill.startPose(flangeForCamera(robot, {0.0, 0.42, 0.85}), clock.now());
  EXPECT_EQ(run().failure_code, "in_collision") << status.text;
  EXPECT_LT((arm.state()->q - home()).norm(), 1e-6);
}

TEST_F(MoveArmTest, DoesNotMoveWhereTheLiveCloudShowsSomething) {
  const Pose2 X_odom_base{4.0, -2.0, 0.7};
  TestSurroundings around(clock, [&] { return X_odom_base; });
  skill.setSurroundings(&around);
  const Eigen::Isometry3d goal = flangeForCamera(robot, {1.25, 0.0, 1.3});
  const Eigen::Vector3d at = toIsometry(X_odom_base) * Eigen::Vector3d(goal.translation());
  around.stand(at.x(), at.y(), at.z());
  const Vector6d before = arm.state()->q;
  skill.startPose(goal, clock.now());
  run();
  EXPECT_EQ(status.failure_code, "obstacle") << status.text;
  EXPECT_NE(status.text.find("something stands where the"), std::string::npos) << status.text;
  EXPECT_LT((arm.state()->q - before).cwiseAbs().maxCoeff(), 1e-3);
  around.points.clear();
  skill.startPose(goal, clock.now());
  EXPECT_EQ(run().phase, SkillPhase::Done) << status.text;
  around.silent = true;
  advance(3.0);
  skill.startJoints(home(), clock.now());
  EXPECT_EQ(run().failure_code, "obstacle");
  EXPECT_NE(status.text.find("blindly"), std::string::npos) << status.text;
}

/// What is told with a motion is the planner's business, not the watch's.
TEST_F(MoveArmTest, TheLiveCloudMayShowWhatTheMotionWasToldOf) {
  const Pose2 X_odom_base{4.0, -2.0, 0.7};
  TestSurroundings around(clock, [&] { return X_odom_base; });
  skill.setSurroundings(&around);
  const Eigen::Isometry3d goal = flangeForCamera(robot, {1.25, 0.0, 1.3});
  const Eigen::Vector3d shelf = goal * Eigen::Vector3d(0.0, 0.08, 0.2);  // before the gripper
  const Eigen::Vector3d at = toIsometry(X_odom_base) * shelf;
  around.stand(at.x(), at.y(), at.z());
  skill.startPose(goal, clock.now());
  EXPECT_EQ(run().failure_code, "obstacle") << status.text;
  ArmMoveTerms terms;
  terms.scene.boxes = {makeBox(Eigen::Isometry3d(Eigen::Translation3d(shelf)),
                               Eigen::Vector3d::Constant(0.03), "shelf")};
  terms.scene.touchable = {"shelf"};
  skill.setTerms(terms);
  skill.startPose(goal, clock.now());
  EXPECT_EQ(run().phase, SkillPhase::Done) << status.text;
}

TEST_F(MoveArmTest, CheckAnswersWithoutMoving) {
  const auto good = skill.check(flangeForCamera(robot, {1.25, 0, 1.1}));
  ASSERT_TRUE(good.has_value()) << good.error();
  EXPECT_NEAR(robot.X_base_flange(*good).translation().x(), 1.12, 0.005);
  const auto far = skill.check(flangeForCamera(robot, {3.0, 0, 1.0}));
  ASSERT_FALSE(far.has_value());
  // The fire box stands 2.15 m ahead minus its recess: at 1.9 m the head would be inside it, or out
  // of reach.
  X_map_base.x_m += 0.75;
  const auto near = skill.check(flangeForCamera(robot, {1.35, 0, 1.0}));
  ASSERT_FALSE(near.has_value());
  EXPECT_NE(near.error().message.find("place 1"), std::string::npos) << near.error();
}

TEST_F(MoveArmTest, ContactEndsTheMoveAndTheNextMoveWorks) {
  skill.startJoints(RobotGeometry::radians(robot.q_park_deg), clock.now());
  polling = true;
  advance(0.5);
  ASSERT_EQ(status.phase, SkillPhase::Running);
  arm.setForce({0, 0, 90});
  advance(0.3);
  EXPECT_EQ(status.failure_code, "contact") << status.text;
  const Vector6d at = arm.state()->q;
  advance(0.5);
  EXPECT_LT((arm.state()->q - at).cwiseAbs().maxCoeff(), 0.05);
  arm.setForce({0, 0, 0});
  skill.startJoints(home(), clock.now());
  EXPECT_EQ(run().phase, SkillPhase::Done) << status.failure_code << ": " << status.text;
}

TEST_F(MoveArmTest, GoesBackOnItsWayFromAContactThatStillPresses) {
  const Vector6d begin = arm.state()->q;
  ASSERT_NO_FATAL_FAILURE(meetSomething());
  const Vector6d at = arm.state()->q;
  arm.setForce({0, 0, 80});  // the arm rests and leans on it
  skill.startBack(0.6, clock.now());
  advance(0.6);
  arm.setForce({0, 0, 0});  // by now it is clear
  EXPECT_EQ(run().phase, SkillPhase::Done) << status.failure_code << ": " << status.text;
  EXPECT_LT((arm.state()->q - begin).norm(), (at - begin).norm() - 0.05);

  ASSERT_NO_FATAL_FAILURE(meetSomething());
  skill.startBack(1.0, clock.now());
  advance(0.3);
  ASSERT_EQ(status.phase, SkillPhase::Running) << status.failure_code << ": " << status.text;
  arm.setForce({0, 0, 140});  // presses harder than it did: the way back is not free either
  advance(0.3);
  EXPECT_EQ(status.failure_code, "contact") << status.text;
}

TEST_F(MoveArmTest, ProtectiveStopAndStopEndTheMove) {
  skill.startJoints(RobotGeometry::radians(robot.q_park_deg), clock.now());
  polling = true;
  advance(0.5);
  arm.setSafety(ArmSafetyMode::ProtectiveStop);
  advance(0.1);
  EXPECT_EQ(status.failure_code, "protective_stop");
  skill.startJoints(home(), clock.now());
  EXPECT_EQ(run().failure_code, "protective_stop");
  ASSERT_TRUE(controller.releaseProtectiveStop());
  advance(0.1);
  skill.startJoints(RobotGeometry::radians(robot.q_park_deg), clock.now());
  polling = true;
  advance(0.3);
  ASSERT_EQ(status.phase, SkillPhase::Running) << status.text;
  stop.set("operator", clock.now());
  advance(0.1);
  EXPECT_EQ(status.failure_code, "stopped");
}

TEST_F(MoveArmTest, AJammedArmFailsAsTracking) {
  skill.startJoints(RobotGeometry::radians(robot.q_park_deg), clock.now());
  arm.jam(true);
  EXPECT_EQ(run(20.0).failure_code, "tracking") << status.text;
}

// A machine too busy to run the mission loop for longer than a setpoint lives.
TEST_F(MoveArmTest, TakesAMoveUpAgainAfterTheLoopSlipped) {
  active = &slow;
  slow.startJoints(RobotGeometry::radians(robot.q_park_deg), clock.now());
  polling = true;
  advance(0.8);
  for (const double gap_s : {0.15, 0.4, 1.2}) {
    polling = false;
    advance(gap_s);
    polling = true;
    advance(0.9);
    ASSERT_EQ(status.phase, SkillPhase::Running) << status.failure_code << ": " << status.text;
  }
  EXPECT_EQ(run().phase, SkillPhase::Done) << status.failure_code << ": " << status.text;
}

TEST_F(MoveArmTest, GivesUpAMoveThatIsInterruptedAgainAndAgain) {
  active = &slow;
  slow.startJoints(RobotGeometry::radians(robot.q_park_deg), clock.now());
  for (int k = 0; k < 20 && status.phase != SkillPhase::Failed; ++k) {
    polling = true;
    advance(0.5);
    polling = false;
    advance(0.4);
  }
  EXPECT_EQ(status.failure_code, "tracking");
  EXPECT_NE(status.text.find("after 4 new tries"), std::string::npos) << status.text;
}

TEST_F(MoveArmTest, OfAnInterruptedPathOnlyTheRestIsDone) {
  skill.startPose(flangeForCamera(robot, {1.25, 0.3, 1.3}), clock.now());
  ASSERT_EQ(run().phase, SkillPhase::Done) << status.failure_code << ": " << status.text;
  // Across, down and back: 0.6 + 0.3 + 0.6 m at 0.25 m/s.
  skill.startCartesian(
      {flangeForCamera(robot, {1.25, -0.3, 1.3}), flangeForCamera(robot, {1.25, -0.3, 1.0}),
       flangeForCamera(robot, {1.25, 0.3, 1.0})},
      true, clock.now());
  polling = true;
  advance(4.0);  // on the way down
  polling = false;
  advance(0.5);
  polling = true;
  double highest = 0.0, right_end = 0.0;
  while (status.phase == SkillPhase::Running) {
    tick();
    const Eigen::Vector3d p =
        (robot.X_base_flange(arm.state()->q) * robot.X_flange_thermal.pose()).translation();
    highest = std::max(highest, p.z());
    right_end = std::min(right_end, p.y());
  }
  EXPECT_EQ(status.phase, SkillPhase::Done) << status.failure_code << ": " << status.text;
  EXPECT_LT(highest, 1.29) << "the first line was driven again";
  EXPECT_LT(right_end, -0.27) << "the corner was cut";
}

TEST_F(MoveArmTest, GoesAroundAnObstacleByPlanningInSlices) {
  BoxConfig post;
  post.name = "post";
  post.center.xyz_m = {0.95, -0.35, 0.95};
  post.size_m = {0.1, 0.1, 0.7};
  ArenaMap cluttered;
  cluttered.walls = {post};
  X_map_base = {0, 0, 0};
  MoveArm around{{}, robot, cluttered, controller, arm, [this] { return X_map_base; }};
  Vector6d goal = home();
  goal[0] -= 1.9;
  around.startJoints(goal, clock.now());
  bool planned = false;
  SkillStatus s = around.poll(clock.now());
  for (int k = 0; k < 20000 && s.phase == SkillPhase::Running; ++k) {
    tick();
    if (ticks % 5 == 0) s = around.poll(clock.now());
    planned = planned || s.text.find("planning") != std::string::npos;
  }
  EXPECT_EQ(s.phase, SkillPhase::Done) << s.failure_code << ": " << s.text;
  EXPECT_TRUE(planned);
  EXPECT_LT((arm.state()->q - goal).cwiseAbs().maxCoeff(), 0.01);
}

TEST_F(MoveArmTest, CancelHoldsTheArm) {
  skill.startJoints(RobotGeometry::radians(robot.q_park_deg), clock.now());
  polling = true;
  advance(0.6);
  polling = false;
  skill.cancel();
  advance(1.0);
  EXPECT_TRUE(controller.tracking().at_rest);
  EXPECT_EQ(skill.poll(clock.now()).phase, SkillPhase::Idle);
}

}  // namespace
}  // namespace kiln
