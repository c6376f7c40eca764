#include <cmath>
#include <cstdlib>
#include <iostream>

#include <benchmark/benchmark.h>

#include "common/config/resources.h"
#include "robot/planning/arm_motion/arm_planner.h"
#include "robot/planning/arm_motion/cartesian_path.h"
#include "robot/planning/arm_motion/ur_inverse.h"
#include "robot/scene/obstacles.h"
#include "tests/support/kitchen.h"

namespace kiln {
namespace {

template <class Config>
Config shipped(const char* file) {
  Config config;
  const auto path = resourcePath(file);
  const auto loaded = path ? loadConfig(*path, config) : tl::make_unexpected(path.error());
  if (!loaded) {
    std::cerr << loaded.error() << '\n';
    std::exit(1);
  }
  return config;
}

/// Bob in front of the first fire place, with all that is known of the kitchen.
struct BobInKitchen {
  RobotGeometry robot = shipped<RobotGeometry>("robot_model/bob.yaml");
  ArmCollision collision{robot};
  Vector6d home = RobotGeometry::radians(robot.q_drive_deg);
  Vector6d park = RobotGeometry::radians(robot.q_park_deg);

  BobInKitchen() {
    const auto [arena, site] = loadWholeKitchen();
    collision.setScene(obstacles(arena), site.places.front().work_pose.pose());
  }
  [[nodiscard]] Eigen::Isometry3d lookAhead(double y, double z) const {
    Eigen::Isometry3d X_base_thermal = Eigen::Isometry3d::Identity();
    X_base_thermal.linear() << 0, 0, 1, -1, 0, 0, 0, -1, 0;
    X_base_thermal.translation() = Eigen::Vector3d(1.25, y, z);
    return flangeFor(X_base_thermal, robot.X_flange_thermal.pose());
  }
  [[nodiscard]] Vector6d postureFor(const Eigen::Isometry3d& X_base_flange) const {
    Vector6d best = home;
    double cost = INFINITY;
    for (const Vector6d& q :
         inverseSolutions(robot.arm, robot.X_base_armbase.pose().inverse() * X_base_flange)) {
      const Vector6d near = nearestTurn(robot.arm, q, home);
      if ((near - home).norm() < cost && collision.distance(near) > 0.03) {
        cost = (near - home).norm();
        best = near;
      }
    }
    return best;
  }
};

void inverseKinematics(benchmark::State& state) {
  const BobInKitchen kitchen;
  const Eigen::Isometry3d X = kitchen.robot.arm.forward(kitchen.home);
  for (auto _ : state) benchmark::DoNotOptimize(inverseSolutions(kitchen.robot.arm, X));
}
BENCHMARK(inverseKinematics)->Unit(benchmark::kMicrosecond);

void collisionOfOnePosture(benchmark::State& state) {
  const BobInKitchen kitchen;
  for (auto _ : state) benchmark::DoNotOptimize(kitchen.collision.distance(kitchen.home));
}
BENCHMARK(collisionOfOnePosture)->Unit(benchmark::kMicrosecond);

void straightMoveCheck(benchmark::State& state) {
  const BobInKitchen kitchen;
  for (auto _ : state) {
    benchmark::DoNotOptimize(kitchen.collision.pathIsFree(kitchen.home, kitchen.park, 0.03));
  }
}
BENCHMARK(straightMoveCheck)->Unit(benchmark::kMicrosecond);

void searchRaster(benchmark::State& state) {
  const BobInKitchen kitchen;
  const Vector6d q0 = kitchen.postureFor(kitchen.lookAhead(-0.35, 1.3));
  std::vector<Eigen::Isometry3d> raster;
  double side = 1.0;
  for (double z = 1.3; z > 0.85; z -= 0.1, side = -side) {
    raster.push_back(kitchen.lookAhead(-side * 0.35, z));
    raster.push_back(kitchen.lookAhead(side * 0.35, z));
  }
  for (auto _ : state) {
    const auto paths = cartesianPaths(kitchen.robot, kitchen.collision, {}, q0, raster, true);
    if (!paths) state.SkipWithError(paths.error().message.c_str());
    benchmark::DoNotOptimize(paths);
  }
}
BENCHMARK(searchRaster)->Unit(benchmark::kMillisecond);

void planAroundAPost(benchmark::State& state) {
  BobInKitchen kitchen;
  BoxConfig post;
  post.name = "post";
  post.center.xyz_m = {0.95, -0.35, 0.95};
  post.size_m = {0.1, 0.1, 0.7};
  kitchen.collision.setScene({post}, Pose2{});
  Vector6d goal = kitchen.home;
  goal[0] -= 1.9;
  int seed = 0, iterations = 0, found = 0;
  for (auto _ : state) {
    ArmPlanner::Config config;
    config.seed = ++seed;
    ArmPlanner planner(config, kitchen.robot, kitchen.collision);
    auto progress = planner.start(kitchen.home, {goal});
    while (progress == ArmPlanner::Progress::Running) progress = planner.advance(100);
    found += progress == ArmPlanner::Progress::Found ? 1 : 0;
    iterations += planner.iterations();
  }
  state.counters["found"] = benchmark::Counter(found, benchmark::Counter::kAvgIterations);
  state.counters["tries"] = benchmark::Counter(iterations, benchmark::Counter::kAvgIterations);
}
BENCHMARK(planAroundAPost)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace kiln
