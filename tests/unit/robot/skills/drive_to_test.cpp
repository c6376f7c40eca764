#include "robot/skills/drive_to.h"

#include <cmath>
#include <random>

#include "tests/support/fake_devices.h"
#include "tests/unit/robot/planning/arm_motion/bob.h"
#include "tests/unit/robot/skills/fake_surroundings.h"

namespace kiln {
namespace {

using std::chrono::milliseconds;
constexpr Duration kTick = milliseconds(4);

class DriveToTest : public ::testing::Test {
 protected:
  DriveToTest() {
    base.setTruePose({0, 0, 0});
    for (int k = 0; k < 10; ++k) tick();
  }
  /// One control tick at 125 Hz; the mission runs at 50 Hz.
  void tick() {
    clock.advanceBy(kTick);
    ++ticks;
    base.advance();
    if (ticks % 2 == 0) {
      controller.tick(clock.now());
      const Twist2 v = controller.tracking().commanded;
      const Eigen::Vector2d now(v.vx_mps, v.vy_mps);
      max_accel = std::max(max_accel, (now - last_v).norm() / toSeconds(2 * kTick));
      last_v = now;
    }
    if (ticks % 5 == 0 && polling) status = drive.poll(clock.now());
  }
  SkillStatus run(const std::vector<Pose2>& waypoints, double limit_s = 120.0) {
    drive.start(waypoints, clock.now());
    polling = true;
    status = drive.poll(clock.now());
    const Stamp end = clock.now() + fromSeconds(limit_s);
    while (status.phase == SkillPhase::Running && clock.now() < end) tick();
    polling = false;
    return status;
  }
  Pose2 measuredPose() {
    Pose2 pose = offset * base.truePose();
    pose.x_m += noise_m * normal(random);
    pose.y_m += noise_m * normal(random);
    pose.yaw_rad += 0.2 * noise_m * normal(random);
    return pose;
  }

  ManualClock clock{Stamp{std::chrono::seconds(10)}};
  RobotGeometry robot = loadBob();
  ArenaMap arena = loadKitchen();
  FireSiteMap site = loadKitchenSite();
  FakeBase base{clock, robot};
  StopLatch stop;
  BaseController controller{{}, robot, base, stop};
  std::mt19937 random{5};
  std::normal_distribution<double> normal{0.0, 1.0};
  double noise_m = 0.0;
  Pose2 offset;  ///< of localisation against the truth
  DriveTo drive{{}, robot, arena, controller, [this] { return measuredPose(); }};
  SkillStatus status;
  bool polling = false;
  int ticks = 0;
  double max_accel = 0.0;
  Eigen::Vector2d last_v = Eigen::Vector2d::Zero();
};

TEST_F(DriveToTest, DrivesThroughTheDoorToTheFirstFirePlace) {
  std::vector<Pose2> way;
  for (const auto& waypoint : arena.entry_path) way.push_back(waypoint.pose());
  for (const auto& waypoint : site.places[0].via) way.push_back(waypoint.pose());
  const Pose2 goal = site.places[0].work_pose.pose();
  way.push_back(goal);
  const Stamp begin = clock.now();
  run(way);
  ASSERT_EQ(status.phase, SkillPhase::Done) << status.failure_code << ": " << status.text;
  const Pose2 end = base.truePose();
  EXPECT_LT(std::hypot(end.x_m - goal.x_m, end.y_m - goal.y_m), 0.02);
  EXPECT_LT(std::abs(wrapAngle(end.yaw_rad - goal.yaw_rad)), 0.5 * M_PI / 180);
  EXPECT_LT(toSeconds(clock.now() - begin), 25.0);  // 10.6 m at up to 1 m/s
  EXPECT_LE(max_accel, 0.8 + 1e-6);
  EXPECT_TRUE(controller.tracking().at_rest);
}

TEST_F(DriveToTest, ArrivesSidewaysAndTurning) {
  run({{0, 1.5, M_PI / 2}});
  ASSERT_EQ(status.phase, SkillPhase::Done) << status.failure_code << ": " << status.text;
  EXPECT_NEAR(base.truePose().y_m, 1.5, 0.02);
  EXPECT_NEAR(base.truePose().yaw_rad, M_PI / 2, 0.01);
}

TEST_F(DriveToTest, StaysSmoothAndArrivesWithNoiseAndJumpsOfThePose) {
  noise_m = 0.004;
  drive.start({{3.0, 0.5, 0.0}}, clock.now());
  polling = true;
  status = drive.poll(clock.now());
  for (int k = 0; k < 20000 && status.phase == SkillPhase::Running; ++k) {
    if (k == 500) offset = {0.06, -0.05, 0.01};
    if (k == 1000) offset = {-0.04, 0.05, -0.01};
    tick();
  }
  ASSERT_EQ(status.phase, SkillPhase::Done) << status.failure_code << ": " << status.text;
  EXPECT_LE(max_accel, 0.8 + 1e-6);
  const Pose2 believed = offset * base.truePose();
  EXPECT_LT(std::hypot(believed.x_m - 3.0, believed.y_m - 0.5), 0.03);
}

/// The mapping drive turns and moves at once, and localisation corrects all the way.
TEST_F(DriveToTest, TakesOffWhereItsWheelsPointAndDoesNotTurnThemAgainAndAgain) {
  noise_m = 0.006;
  std::vector<Pose2> way;
  for (const auto& waypoint : arena.mapping_path) way.push_back(waypoint.pose());
  drive.start(way, clock.now());
  polling = true;
  status = drive.poll(clock.now());
  int stops = 0;
  for (bool before = true; status.phase == SkillPhase::Running;) {
    tick();
    const bool aligning = controller.tracking().aligning;
    if (aligning && !before) ++stops;
    before = aligning;
  }
  ASSERT_EQ(status.phase, SkillPhase::Done) << status.failure_code << ": " << status.text;
  EXPECT_LE(stops, 20);
}

TEST_F(DriveToTest, IsThereAtOnceWhenItStandsThere) {
  run({{0, 0, 0}}, 3.0);
  EXPECT_EQ(status.phase, SkillPhase::Done) << status.text;
}

TEST_F(DriveToTest, RefusesWaypointsOutsideTheFenceAndThroughWalls) {
  EXPECT_EQ(run({{30, 0, 0}}).failure_code, "geofence");
  EXPECT_EQ(run({{NAN, 0, 0}}).failure_code, "geofence");
  EXPECT_EQ(run({{0, 3, 0}, {8, 3, 0}}).failure_code, "in_collision");
  EXPECT_NE(status.text.find("west wall north"), std::string::npos) << status.text;
  EXPECT_NEAR(base.truePose().x_m, 0.0, 1e-9);
}

/// Of another robot than this one it says nothing: the smaller one passes where the larger does not.
TEST_F(DriveToTest, KeepsClearByTheFootprintOfItsOwnRobot) {
  arena.walls = {{"post", {}, {0.1, 0.1, 2.0}}};
  arena.walls[0].center.xyz_m = {1.5, 0.6, 1.0};
  EXPECT_EQ(run({{3, 0, 0}}).failure_code, "in_collision");
  RobotGeometry small = robot;
  small.length_m = 1.08;
  small.width_m = 0.78;
  DriveTo narrow{{}, small, arena, controller, [this] { return measuredPose(); }};
  narrow.start({{3, 0, 0}}, clock.now());
  EXPECT_EQ(narrow.poll(clock.now()).phase, SkillPhase::Running);
}

TEST_F(DriveToTest, NoticesThatItIsStuck) {
  base.jam(true);
  run({{2, 0, 0}}, 30.0);
  EXPECT_EQ(status.phase, SkillPhase::Failed);
  EXPECT_EQ(status.failure_code, "stuck");
}

TEST_F(DriveToTest, StopEndsItAndItDoesNotGoOnByItself) {
  drive.start({{3, 0, 0}}, clock.now());
  polling = true;
  for (int k = 0; k < 500; ++k) tick();
  ASSERT_EQ(status.phase, SkillPhase::Running);
  stop.set("operator", clock.now());
  for (int k = 0; k < 250; ++k) tick();
  EXPECT_EQ(status.failure_code, "stopped");
  ASSERT_TRUE(stop.clear(stop.generation()));
  const Pose2 at = base.truePose();
  for (int k = 0; k < 250; ++k) tick();
  EXPECT_NEAR(base.truePose().x_m, at.x_m, 0.002);
}

TEST_F(DriveToTest, WaitsBeforeWhatStandsInTheWayAndGoesOnWhenItIsGone) {
  TestSurroundings around(clock, [this] { return controller.tracking().X_odom_base; });
  around.stand(3.2, 0.3, 0.6);
  drive.setSurroundings(&around);
  drive.start({{4, 0, 0}}, clock.now());
  polling = true;
  for (int k = 0; k < 12 * 250; ++k) tick();
  ASSERT_EQ(status.phase, SkillPhase::Running) << status.text;
  EXPECT_NE(status.text.find("path blocked by something 0."), std::string::npos) << status.text;
  EXPECT_TRUE(controller.tracking().at_rest);
  // The post's near side at 3.15 m, the robot's front 0.95 m ahead of its middle, a gap of 0.45 m.
  EXPECT_LT(base.truePose().x_m, 3.15 - 0.95 - 0.3);
  EXPECT_GT(base.truePose().x_m, 3.15 - 0.95 - 0.8);
  EXPECT_LE(max_accel, 0.8 + 1e-6);
  around.points.clear();
  for (int k = 0; k < 15 * 250 && status.phase == SkillPhase::Running; ++k) tick();
  EXPECT_EQ(status.phase, SkillPhase::Done) << status.failure_code << ": " << status.text;
}

TEST_F(DriveToTest, GivesUpBeforeWhatStaysAndDoesNotDriveBlindly) {
  TestSurroundings around(clock, [this] { return controller.tracking().X_odom_base; });
  drive.setSurroundings(&around);
  around.stand(1.8, 0.0, 0.6);
  const Stamp begin = clock.now();
  run({{4, 0, 0}}, 60.0);
  EXPECT_EQ(status.failure_code, "blocked") << status.text;
  EXPECT_NEAR(toSeconds(clock.now() - begin), 31.0, 3.0);
  around.points.clear();
  drive.start({{4, 0, 0}}, clock.now());
  polling = true;
  for (int k = 0; k < 500; ++k) tick();
  ASSERT_GT(controller.tracking().commanded.vx_mps, 0.2);
  around.silent = true;
  for (int k = 0; k < 750; ++k) tick();
  EXPECT_TRUE(controller.tracking().at_rest);
  EXPECT_NE(status.text.find("no LiDAR scan for"), std::string::npos) << status.text;
}

TEST_F(DriveToTest, CancelRampsToRest) {
  drive.start({{3, 0, 0}}, clock.now());
  polling = true;
  for (int k = 0; k < 500; ++k) tick();
  ASSERT_GT(controller.tracking().commanded.vx_mps, 0.2);
  polling = false;
  drive.cancel();
  for (int k = 0; k < 500; ++k) tick();
  EXPECT_TRUE(controller.tracking().at_rest);
  EXPECT_EQ(drive.poll(clock.now()).phase, SkillPhase::Idle);
}

}  // namespace
}  // namespace kiln
