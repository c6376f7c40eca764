#include "robot/sim/world.h"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/core/units.h"
#include "robot/sim/device_wire.h"
#include "robot/sim/truth_report.h"
#include "tests/support/paths.h"

namespace kiln::sim {
namespace {

using ::testing::HasSubstr;

constexpr double kPeriod = 0.008;

struct WorldTest : ::testing::Test {
  std::unique_ptr<World> make(WorldConfig config = {}, std::uint64_t seed = 1) {
    auto created = World::create(config, seed);
    EXPECT_TRUE(created.has_value()) << created.error();
    return std::move(*created);
  }
  static WheelCommands twist(const RobotGeometry& g, const Twist2& v) {
    WheelCommands out;
    for (std::size_t i = 0; i < 4; ++i) {
      const double x = i < 2 ? g.wheel_x_m : -g.wheel_x_m,
                   y = i % 2 == 0 ? g.wheel_y_m : -g.wheel_y_m;
      const double vx = v.vx_mps - v.wz_radps * y, vy = v.vy_mps + v.wz_radps * x;
      out[i] = {std::atan2(vy, vx), std::hypot(vx, vy) / g.wheel_radius_m};
    }
    return out;
  }
  /// Speeds up over a second, then keeps the twist.
  static WorldReport drive(World& world, const Twist2& v, double seconds) {
    WorldReport report;
    const Stamp end = world.now() + fromSeconds(seconds);
    double share = 0.0;
    while (world.now() < end) {
      share = std::min(1.0, share + kPeriod);
      WorldCommands c;
      c.base = twist(world.robot(), v);
      for (WheelCommand& wheel : *c.base) wheel.drive_radps *= share;
      world.command(c);
      report = world.advance(world.now() + fromSeconds(kPeriod));
    }
    return report;
  }
  static double speed(const WorldReport& r) {
    return std::fabs(r.base.wheels[0].drive_radps) * 0.085;
  }
};

TEST_F(WorldTest, StandsStillWithoutCommands) {
  const auto world = make();
  const Pose2 before = world->truth().starts.front();
  const auto report = world->advance(stampFromNanoseconds(10'000'000'000));
  const Pose2 after = projectToGround(world->truth().X_map_base);
  EXPECT_NEAR(before.x_m, after.x_m, 1e-4);
  EXPECT_NEAR(before.y_m, after.y_m, 1e-4);
  EXPECT_LT(
      (report.arm.q - RobotGeometry::radians(world->robot().q_park_deg)).cwiseAbs().maxCoeff(),
      1e-4);
  EXPECT_TRUE(world->truth().collisions.empty());
}

TEST_F(WorldTest, DrivesCrabsAndTurnsWithFewPercentOfSlip) {
  struct Case {
    Twist2 v;
    double dx, dy, yaw;
  };
  // 1 s of ramp (half a second's worth) and 2 s at speed.
  for (const Case& c : {Case{{1, 0, 0}, 2.5, 0, 0}, Case{{0, 0.5, 0}, 0, 1.25, 0},
                        Case{{0.5, 0.5, 0}, 1.25, 1.25, 0}, Case{{0, 0, 0.5}, 0, 0, 1.25}}) {
    const auto world = make();
    const Pose2 start = world->truth().starts.front();
    (void)drive(*world, c.v, 3.0);
    const Pose2 moved = inverse(start) * projectToGround(world->truth().X_map_base);
    EXPECT_NEAR(moved.x_m, c.dx, 0.15) << c.v.vx_mps << " " << c.v.vy_mps;
    EXPECT_NEAR(moved.y_m, c.dy, 0.15) << c.v.vx_mps << " " << c.v.vy_mps;
    EXPECT_NEAR(moved.yaw_rad, c.yaw, 0.09);
    EXPECT_TRUE(world->truth().collisions.empty());
  }
}

TEST_F(WorldTest, BaseStops250msAfterTheLastSetpoint) {
  const auto world = make();
  EXPECT_NEAR(speed(drive(*world, {1, 0, 0}, 2.0)), 1.0, 0.05);
  EXPECT_NEAR(speed(world->advance(world->now() + fromSeconds(0.24))), 1.0, 0.05);
  // From 1 m/s at 2 m/s^2: 0.5 s; the wheels follow a little later.
  EXPECT_NEAR(speed(world->advance(world->now() + fromSeconds(0.25))), 0.5, 0.1);
  EXPECT_LT(speed(world->advance(world->now() + fromSeconds(0.4))), 0.05);
}

TEST_F(WorldTest, NobodyBrakesTheBaseHarderThanItsDrivesCan) {
  const auto world = make();
  const double before = speed(drive(*world, {1, 0, 0}, 2.0));
  const double after = speed(drive(*world, {0, 0, 0}, 0.25));
  EXPECT_NEAR(after, before - 0.5, 0.03) << "2 m/s^2 for 0.25 s; the speed loop lags a little";
}

TEST_F(WorldTest, ThePlateIsLitByTheMissionsClockOnceAndForAll) {
  const auto world = make();
  const auto plateAfter = [&](double seconds, const WorldCommands& commands) {
    world->command(commands);
    (void)world->advance(world->now() + fromSeconds(seconds));
    return world->truth().fire.plate_c;
  };
  WorldCommands start, reset;
  start.start_clock = true;
  reset.request_reset = true;
  EXPECT_EQ(plateAfter(5.0, {}), 25.0) << "nobody has started the clock";
  EXPECT_NEAR(plateAfter(6.0, start), 25.0 + 105.0 * (1.0 - std::exp(-0.1)), 0.1);
  EXPECT_NEAR(plateAfter(6.0, start), 25.0 + 105.0 * (1.0 - std::exp(-0.2)), 0.1) << "a resume";
  EXPECT_NEAR(plateAfter(6.0, reset), 25.0 + 105.0 * (1.0 - std::exp(-0.3)), 0.1);
}

TEST_F(WorldTest, TheArmYieldsToLessWithinAMetreOfTheBuilding) {
  const auto world = make();
  EXPECT_EQ(drive(*world, {0, 0, 0}, 0.1).arm.safety, ArmSafetyMode::Normal);
  // The building begins at x = 4.9; the head stands at about 0.6 m before the base's middle.
  EXPECT_EQ(drive(*world, {1, 0, 0}, 4.5).arm.safety, ArmSafetyMode::Reduced);
  EXPECT_GT(world->truth().X_map_base.translation().x(), 3.0);
}

TEST_F(WorldTest, TheBatteryEmptiesAndThenNothingMoves) {
  WorldConfig config;
  config.base.battery_ah = 0.03;  // 15 A standing: seven seconds
  const auto world = make(config);
  EXPECT_NEAR(drive(*world, {0, 0, 0}, 0.1).base.battery_v, 32.5, 0.8);
  const BaseState full = drive(*world, {0.5, 0, 0}, 1.5).base;
  EXPECT_GT(full.battery_a, 15.0) << "it drives";
  const BaseState low = drive(*world, {0.5, 0, 0}, 3.0).base;
  EXPECT_LT(low.battery_v, full.battery_v - 1.0);
  const WorldReport empty = drive(*world, {0.5, 0, 0}, 5.0);
  EXPECT_LT(speed(empty), 0.01);
  EXPECT_FALSE(empty.arm.powered);
  EXPECT_LT(empty.base.battery_v, 24.5);
  EXPECT_NEAR(empty.base.battery_a, 0.0, 0.5);
}

TEST_F(WorldTest, ABatteryLastsAboutAnHourOfStanding) {
  WorldConfig config;
  const auto world = make(config);
  const double before = drive(*world, {0, 0, 0}, 1.0).base.battery_a;
  EXPECT_NEAR(config.base.battery_ah / before * 60.0, 80.0, 15.0) << "minutes; driving takes more";
}

TEST_F(WorldTest, ArmTracksASmoothMotionAndHoldsAfterIt) {
  const auto world = make();
  const Vector6d from = RobotGeometry::radians(world->robot().q_park_deg);
  Vector6d way = RobotGeometry::radians(world->robot().q_drive_deg) - from;
  way[0] += 0.8;  // swings out to the side
  way[5] -= 1.0;
  double worst = 0.0;
  WorldReport report;
  for (double t = 0.0; t < 2.0; t += kPeriod) {
    const double s = t / 2.0, p = s * s * s * (10 - 15 * s + 6 * s * s),
                 v = 15.0 * s * s * (1 - s) * (1 - s);
    WorldCommands c;
    c.arm = ArmServo{from + p * way, v * way};
    world->command(c);
    report = world->advance(world->now() + fromSeconds(kPeriod));
    const double s1 = (t + kPeriod) / 2.0, p1 = s1 * s1 * s1 * (10 - 15 * s1 + 6 * s1 * s1);
    worst = std::max(worst, (report.arm.q - from - p1 * way).cwiseAbs().maxCoeff());
  }
  EXPECT_LT(worst, 0.5 * kDeg);
  report = world->advance(world->now() + fromSeconds(2.0));
  EXPECT_LT((report.arm.q - from - way).cwiseAbs().maxCoeff(), 1e-3);
  EXPECT_LT(report.arm.qd.cwiseAbs().maxCoeff(), 1e-3);
}

TEST_F(WorldTest, ArmThatLosesItsServoInMotionStopsByItself) {
  const auto world = make();
  Vector6d q = RobotGeometry::radians(world->robot().q_park_deg), qd = Vector6d::Zero();
  for (int i = 0; i < 125; ++i) {
    qd[0] = -0.5 * std::min(1.0, i / 60.0);
    q += kPeriod * qd;
    WorldCommands c;
    c.arm = ArmServo{q, qd};
    world->command(c);
    (void)world->advance(world->now() + fromSeconds(kPeriod));
  }
  (void)world->advance(world->now() + fromSeconds(0.5));
  const auto report = world->advance(world->now() + fromSeconds(0.1));
  EXPECT_LT(report.arm.qd.cwiseAbs().maxCoeff(), 1e-3);
  EXPECT_EQ(report.arm.safety, ArmSafetyMode::Normal);
  EXPECT_GT(report.arm.q[0], q[0] - 0.2);
}

TEST_F(WorldTest, JumpOfTheServoTargetIsAProtectiveStopUntilReleased) {
  const auto world = make();
  const Vector6d park = RobotGeometry::radians(world->robot().q_park_deg);
  WorldCommands c;
  c.arm = ArmServo{park + Vector6d::Constant(0.3), Vector6d::Zero()};
  world->command(c);
  auto report = world->advance(world->now() + fromSeconds(0.5));
  EXPECT_EQ(report.arm.safety, ArmSafetyMode::ProtectiveStop);
  EXPECT_THAT(report.refused, HasSubstr("rad/s"));
  EXPECT_LT((report.arm.q - park).cwiseAbs().maxCoeff(), 0.01);
  c.arm = ArmServo{park, Vector6d::Zero()};  // a good target does not end it
  world->command(c);
  EXPECT_EQ(world->advance(world->now() + fromSeconds(0.1)).arm.safety,
            ArmSafetyMode::ProtectiveStop);
  WorldCommands release;
  release.release_protective_stop = true;
  world->command(release);
  report = world->advance(world->now() + fromSeconds(0.1));
  EXPECT_EQ(report.arm.safety, ArmSafetyMode::Normal);
  EXPECT_EQ(report.refused, "");
}

// A busy machine: the world's clock waited, and of the targets that were sent meanwhile only the
// newest arrives. It fits the time that passed at the sender.
TEST_F(WorldTest, ATargetIsJudgedByThePaceOfItsSending) {
  auto world = make();
  Vector6d q = RobotGeometry::radians(world->robot().q_park_deg);
  const Stamp sent = stampFromNanoseconds(5'000'000'000);
  WorldCommands c;
  c.arm = ArmServo{q, Vector6d::Zero()};
  c.arm_sent = sent;
  world->command(c);
  q[0] -= 0.08;  // 0.8 rad/s for 100 ms
  c.arm = ArmServo{q, Vector6d::Zero()};
  c.arm_sent = sent + std::chrono::milliseconds(100);
  world->command(c);
  EXPECT_EQ(world->advance(world->now() + fromSeconds(kPeriod)).arm.safety, ArmSafetyMode::Normal);
  q[0] -= 0.5;
  c.arm = ArmServo{q, Vector6d::Zero()};
  c.arm_sent = sent + std::chrono::milliseconds(140);
  world->command(c);
  EXPECT_EQ(world->advance(world->now() + fromSeconds(kPeriod)).arm.safety,
            ArmSafetyMode::ProtectiveStop);
}

TEST_F(WorldTest, NanAndOutOfRangeCommandsMoveNothing) {
  const auto world = make();
  WorldCommands c;
  c.base = WheelCommands{};
  (*c.base)[2].drive_radps = std::nan("");
  world->command(c);
  EXPECT_THAT(world->advance(world->now() + fromSeconds(0.1)).refused, HasSubstr("wheel 3"));
  c.base = WheelCommands{};
  (*c.base)[1].drive_radps = 1000.0;
  world->command(c);
  EXPECT_THAT(world->advance(world->now() + fromSeconds(0.1)).refused, HasSubstr("wheel 2"));
  EXPECT_LT(speed(world->advance(world->now() + fromSeconds(0.5))), 1e-3);
}

TEST_F(WorldTest, RunningIntoAWallIsOneCollisionInTheTruth) {
  const auto world = make();
  (void)drive(*world, {0, 0.7, 0}, 4.0);  // in front of the wall beside the door
  (void)drive(*world, {0.7, 0, 0}, 7.0);
  const Truth truth = world->truth();
  ASSERT_GE(truth.collisions.size(), 1u);
  EXPECT_THAT(truth.collisions[0].b, HasSubstr("wall"));
  EXPECT_GT(truth.collisions[0].force_n, 5.0);
  EXPECT_LT(projectToGround(truth.X_map_base).x_m,
            4.1);  // wall at 4.9, half the robot is 0.95 long
}

TEST_F(WorldTest, ResetCarriesTheRobotHomeAndLeavesTheClockRunning) {
  const auto world = make();
  const Stamp before = world->now() + fromSeconds(3.0);
  (void)drive(*world, {0.8, 0, 0.2}, 3.0);
  WorldCommands c;
  c.request_reset = true;
  world->command(c);
  const auto report = world->advance(world->now() + fromSeconds(0.1));
  EXPECT_EQ(report.resets, 1u);
  EXPECT_GE(report.now, before);
  EXPECT_LT(
      (report.arm.q - RobotGeometry::radians(world->robot().q_park_deg)).cwiseAbs().maxCoeff(),
      1e-3);
  for (const WheelState& wheel : report.base.wheels) EXPECT_NEAR(wheel.drive_angle_rad, 0.0, 0.005);
  const Pose2 at = projectToGround(world->truth().X_map_base);
  EXPECT_LT(std::hypot(at.x_m, at.y_m), 0.2 * std::sqrt(2.0) + 0.01);  // +-20 cm each way
  ASSERT_EQ(world->truth().starts.size(), 2u);
  EXPECT_NE(world->truth().starts[0].x_m,
            world->truth().starts[1].x_m);  // people do not hit the same spot twice
  (void)world->advance(world->now() + fromSeconds(1.0));
  EXPECT_TRUE(world->truth().collisions.empty());
}

TEST_F(WorldTest, ServoTargetsUnderWayAtAResetAreDroppedAndLaterJumpsStillStop) {
  const auto world = make();
  Vector6d q = RobotGeometry::radians(world->robot().q_park_deg), qd = Vector6d::Zero();
  WorldCommands c;
  for (int i = 0; i < 250; ++i) {  // somewhere far from the park posture
    qd[0] = -0.5 * std::min(1.0, i / 60.0);
    q += kPeriod * qd;
    c.arm = ArmServo{q, qd};
    world->command(c);
    (void)world->advance(world->now() + fromSeconds(kPeriod));
  }
  WorldCommands reset;
  reset.request_reset = true;
  world->command(reset);
  WorldReport report;
  for (int i = 0; i < 5; ++i) {  // 40 ms: the robot has not heard of it yet
    world->command(c);
    report = world->advance(world->now() + fromSeconds(kPeriod));
  }
  EXPECT_EQ(report.arm.safety, ArmSafetyMode::Normal);
  EXPECT_EQ(report.refused, "");
  const Vector6d park = RobotGeometry::radians(world->robot().q_park_deg);
  EXPECT_LT((report.arm.q - park).cwiseAbs().maxCoeff(), 1e-3);
  (void)world->advance(world->now() + fromSeconds(0.1));
  world->command(c);
  EXPECT_EQ(world->advance(world->now() + fromSeconds(0.1)).arm.safety,
            ArmSafetyMode::ProtectiveStop);
}

/// Ten seconds with everything on, as bytes.
std::string record(std::uint64_t seed) {
  WorldConfig config = *WorldConfig::load(kiln::sourceDir() + "/resources/worlds/fire.yaml");
  for (const char* fault : {"people=3@0", "kidnap=0.3@1", "view_blocked@1.5"})
    config.faults.push_back(*FaultConfig::parse(fault));
  auto world = World::create(config, seed);
  std::string out;
  WorldCommands c;
  c.sensors = SensorRequest{true, true, false};
  for (int i = 0; i < 250; ++i) {
    c.base = WorldTest::twist((*world)->robot(), {0.4, 0.1, 0.1});
    c.pumps = {1.0, 0.5};
    (*world)->command(c);
    v1::device::Report message;
    toProto((*world)->advance(stampFromNanoseconds((i + 1) * 8'000'000LL)), message);
    out += message.SerializeAsString();
    c.sensors.reset();
  }
  return out + truthJson((*world)->truth());
}

TEST_F(WorldTest, SameSeedSameBytesOtherSeedOtherBytes) {
  const std::string first = record(3);
  EXPECT_GT(first.size(), 1'000'000u);  // scans and images are in it
  EXPECT_TRUE(first == record(3));
  EXPECT_FALSE(first == record(4));
}

TEST_F(WorldTest, SensorsRunOnlyWhenAsked) {
  const auto world = make();
  auto report = world->advance(world->now() + fromSeconds(0.5));
  EXPECT_TRUE(report.lidar.empty() && report.thermal.empty() && report.colour.empty());
  WorldCommands c;
  c.sensors = SensorRequest{true, true, true};
  world->command(c);
  report = world->advance(world->now() + fromSeconds(1.0));
  EXPECT_NEAR(static_cast<double>(report.lidar.size()), 9, 1);
  EXPECT_NEAR(static_cast<double>(report.thermal.size()), 9, 1);
  EXPECT_NEAR(static_cast<double>(report.colour.size()), 10, 1);
  EXPECT_EQ(report.colour.front()->width, 1280);
}

TEST_F(WorldTest, PerturbationsStayWithinTheScenario) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const auto world = make({}, seed);
    const Truth truth = world->truth();
    EXPECT_LT(std::fabs(truth.starts[0].x_m), 0.2);
    EXPECT_LT(std::fabs(truth.starts[0].yaw_rad), 5.01 * kDeg);
    const Eigen::Vector3d nominal[2] = {{12.1, 2.8, 1.0}, {10.6, -4.6, 1.0}};
    for (std::size_t i = 0; i < 2; ++i) {
      const Eigen::Vector3d off = truth.arena.fire_places[i].plateInMap() - nominal[i];
      EXPECT_LT(std::fabs(off.x()), 0.105);
      EXPECT_LT(std::fabs(off.y()), 0.105);
      EXPECT_LT(std::fabs(off.z()), 0.01);
    }
  }
}

}  // namespace
}  // namespace kiln::sim
