#include <algorithm>
#include <cmath>
#include <cstdio>

#include "robot/sim/ray_scene.h"
#include "tests/support/kitchen.h"
#include "tests/unit/robot/sim/driven_world.h"

namespace kiln::sim {
namespace {

constexpr double kFast = 0.5;  // m/s

double x(const DrivenWorld& w) { return w.pose().translation().x(); }

/// Mean true speed along the ground between two places on the way.
double speedBetween(DrivenWorld& w, double from_x, double to_x, double speed_mps) {
  const double sign = to_x > from_x ? 1.0 : -1.0;
  while (sign * (from_x - x(w)) > 0) w.drive({sign * speed_mps, 0, 0}, 0.008);
  const Eigen::Vector3d p = w.pose().translation();
  const Stamp begin = w.world->now();
  while (sign * (to_x - x(w)) > 0) w.drive({sign * speed_mps, 0, 0}, 0.008);
  return (w.pose().translation() - p).norm() / toSeconds(w.world->now() - begin);
}

TEST(Approach, RobotStandsLevelInTheLowerStartAreaInEverySeed) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    DrivenWorld w(DrivenWorld::fullWorld(), seed);
    w.run(1.0);
    const Truth truth = w.world->truth();
    EXPECT_NEAR(w.pose().translation().z(), truth.arena.ground.lowest(), 1e-3);
    EXPECT_NEAR(w.pitchDeg(), 0.0, 0.02);
    EXPECT_TRUE(truth.collisions.empty());
    EXPECT_FALSE(truth.fell.has_value());
  }
}

TEST(Approach, SlopeAndEdgeDifferBySeedWithinTheScenarioAndOnlyInTheFullWorld) {
  double least = 90, most = 0;
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    const auto [map, site] = loadWholeKitchen();
    const TrueArena full = TrueArena::draw(DrivenWorld::fullWorld(), map, site, {}, seed);
    const ApproachConfig& a = full.ground.approach();
    least = std::min(least, a.slope_deg);
    most = std::max(most, a.slope_deg);
    EXPECT_NEAR(a.edge_m, 0.02, 0.005);
    EXPECT_TRUE(TrueArena::draw({}, map, site, {}, seed).ground.flat());
  }
  EXPECT_GE(least, 3.5);
  EXPECT_LE(most, 4.5);
  EXPECT_GT(most - least, 0.6);
}

TEST(Approach, RaysMeetTheGroundAtTheHeightOnWhichTheWheelsStand) {
  const auto world = std::move(*World::create(DrivenWorld::fullWorld(), 3));
  const TrueArena& arena = world->arena();
  RayScene rays(world->config(), arena, world->robot(), false);
  SceneState far;  // the robot out of the way
  far.X_map_base.translation() = Eigen::Vector3d(-50, 0, 0);
  rays.update(far);
  for (double at = -2.013; at < 4.5; at += 0.1) {
    const Raycaster::Ray down{{static_cast<float>(at), 0.7F, 1.0F}, {0, 0, -1}, 9.0F, mask::kLidar};
    Raycaster::Hit hit;
    rays.rays().cast({&down, 1}, {&hit, 1});
    ASSERT_TRUE(hit.valid()) << at;
    EXPECT_NEAR(1.0 - hit.range, arena.ground.height(at), 1e-4) << at;
  }
}

TEST(Approach, KeepsItsSpeedUpAndDownTheRamp) {
  DrivenWorld w(DrivenWorld::nominalWorld());
  EXPECT_NEAR(speedBetween(w, 1.9, 2.4, kFast), kFast, 0.01 * kFast);
  EXPECT_NEAR(w.pitchDeg(), 4.0, 0.05);
  double current = 0.0;
  for (const double a : w.controller.tracking().drive_current_a) current += a;
  // 163 kg at 4 deg: 112 N, times the wheel radius 9.5 Nm on four motors of 0.52 Nm/A: 18 A.
  EXPECT_NEAR(current, 18.3, 3.0);
  w.drive({}, 2.0);
  EXPECT_NEAR(speedBetween(w, 2.3, 1.8, kFast), kFast, 0.01 * kFast);
  EXPECT_TRUE(w.world->truth().collisions.empty());
}

/// The drives' own integral action is off: they give way under load, as the paper's did.
struct WeakDrives : ::testing::Test {
  static WorldConfig world() {
    WorldConfig config = DrivenWorld::nominalWorld();
    config.base.drive_integral_gain = 0.0;
    return config;
  }
  static BaseController::Config without() {
    BaseController::Config config;
    config.speed_integral_hz = 0.0;
    return config;
  }
};

TEST_F(WeakDrives, SpeedOnTheRampIsMadeGood) {
  DrivenWorld weak(world(), 1, without());
  EXPECT_LT(speedBetween(weak, 1.9, 2.4, kFast), 0.97 * kFast);
  DrivenWorld w(world());
  EXPECT_NEAR(speedBetween(w, 1.9, 2.4, kFast), kFast, 0.01 * kFast);
}

TEST_F(WeakDrives, RobotDoesNotRollBack) {
  DrivenWorld weak(world(), 1, without());
  weak.driveTo(2.4, kFast);
  double from = x(weak);
  weak.drive({}, 8.0);
  EXPECT_LT(x(weak), from - 0.10);
  DrivenWorld w(world());
  w.driveTo(2.4, kFast);
  from = x(w);
  w.drive({}, 8.0);
  EXPECT_NEAR(x(w), from, 0.003);
  EXPECT_TRUE(w.controller.tracking().at_rest);
}

TEST(Approach, HoldsOnTheRampAlsoUnderStopAndWithADeadController) {
  DrivenWorld w(DrivenWorld::nominalWorld());
  w.driveTo(2.4, kFast);
  const double from = x(w);
  w.drive({}, 5.0);
  EXPECT_NEAR(x(w), from, 0.002);
  w.stop.set("test", w.world->now());
  w.run(5.0);
  EXPECT_NEAR(x(w), from, 0.003);
  w.controlled = false;
  w.run(5.0);
  EXPECT_NEAR(x(w), from, 0.004);
  EXPECT_NEAR(w.pitchDeg(), 4.0, 0.1);
}

TEST(Approach, StopsDownhillWithinTheDistanceOfTheScenario) {
  DrivenWorld w(DrivenWorld::nominalWorld());
  w.driveTo(2.9, kFast);
  while (x(w) > 1.9) w.drive({-1.0, 0, 0}, 0.008);
  const double speed = -w.controller.tracking().measured.vx_mps;
  EXPECT_GT(speed, 0.9);
  const double from = x(w);
  w.stop.set("test", w.world->now());
  w.run(2.0);
  // v^2 / (2 x 1.8 m/s^2), the ramp-in of that deceleration (1.8 / 20 s, half of it lost), one
  // tick.
  EXPECT_LT(from - x(w), speed * speed / 3.6 + 0.045 * speed + 0.03);
  EXPECT_TRUE(w.controller.tracking().at_rest);
}

TEST(Approach, CrossesTheEdgeIntoTheKitchenWithoutCollision) {
  for (const double speed : {0.3, 0.6, 1.0}) {
    DrivenWorld w(DrivenWorld::nominalWorld());
    const Vector6d q = w.world->truth().q;
    double arm = 0.0, pitch = 0.0;
    while (x(w) < 5.2 && w.world->now() < Stamp{std::chrono::seconds(40)}) {
      w.drive({speed, 0, 0}, 0.04);
      const Truth truth = w.world->truth();
      arm = std::max(arm, (truth.q - q).cwiseAbs().maxCoeff());
      pitch = std::max(pitch, std::fabs(w.pitchDeg()));
    }
    w.drive({}, 2.0);
    const Truth truth = w.world->truth();
    EXPECT_GT(x(w), 5.2) << speed;
    EXPECT_NEAR(w.pose().translation().z(), 0.0, 1e-3) << speed;
    EXPECT_LT(pitch, 6.0) << speed;
    // The jolt shakes the arm; at 0.6 m/s and below it stays within a degree.
    EXPECT_LT(arm, (speed < 0.7 ? 1.0 : 2.5) * M_PI / 180) << speed;
    EXPECT_TRUE(truth.collisions.empty()) << speed;
    EXPECT_FALSE(truth.fell.has_value());
    // Up the ramp (1.0024 m of way a metre) and over the edge the wheels count more than the map
    // has.
    EXPECT_GT(w.controller.tracking().X_odom_base.x_m - x(w), 0.005) << speed;
  }
}

/// Why the robot needs its LiDAR: driven to the door by somebody who sees, in ten full worlds.
TEST(Approach, OdometryAloneIsCentimetresOffAtTheDoor) {
  std::vector<double> drift, yaw;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    DrivenWorld w(DrivenWorld::fullWorld(), seed);
    const Pose2 start = projectToGround(w.pose());
    while (x(w) < 4.6 && w.world->now() < Stamp{std::chrono::seconds(60)}) {
      const Pose2 at = projectToGround(w.pose());
      w.drive({0.4, -0.8 * at.y_m, -0.8 * at.yaw_rad}, 0.02);
    }
    w.drive({}, 1.0);
    const Pose2 guess = start * w.controller.tracking().X_odom_base;
    const Pose2 off = inverse(guess) * projectToGround(w.pose());
    drift.push_back(std::hypot(off.x_m, off.y_m));
    yaw.push_back(std::fabs(off.yaw_rad) * 180 / M_PI);
    EXPECT_TRUE(w.world->truth().collisions.empty()) << seed;
    std::printf("seed %2d: %.1f mm ahead, %.1f mm aside, %.2f deg\n", static_cast<int>(seed),
                1e3 * off.x_m, 1e3 * off.y_m, off.yaw_rad * 180 / M_PI);
  }
  std::sort(drift.begin(), drift.end());
  std::sort(yaw.begin(), yaw.end());
  std::printf("drift median %.1f mm, worst %.1f mm; heading median %.2f deg, worst %.2f deg\n",
              500 * (drift[4] + drift[5]), 1e3 * drift[9], 0.5 * (yaw[4] + yaw[5]), yaw[9]);
  EXPECT_GT(drift[9], 0.02);  // the figure asked for at the doorway, 2 cm and 0.3 deg
  EXPECT_GT(yaw[9], 0.3);
}

TEST(Approach, ResetFromAnywherePutsTheRobotBackIntoTheStartArea) {
  for (const double to : {2.4, 2.95, 4.6}) {  // on the ramp, on the edge, in the door
    DrivenWorld w;
    while (x(w) < to) w.drive({kFast, 0, 0}, 0.008);
    WorldCommands reset;
    reset.request_reset = true;
    w.world->command(reset);
    w.drive({}, 0.5);
    const Truth truth = w.world->truth();
    EXPECT_LT(std::hypot(x(w), w.pose().translation().y()), 0.35);
    EXPECT_NEAR(w.pose().translation().z(), truth.arena.ground.lowest(), 2e-3);
    EXPECT_NEAR(w.pitchDeg(), 0.0, 0.2);
    EXPECT_EQ(truth.resets, 1u);
    EXPECT_TRUE(truth.collisions.empty());
  }
}

}  // namespace
}  // namespace kiln::sim
