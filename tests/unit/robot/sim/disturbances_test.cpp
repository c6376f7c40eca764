#include "robot/sim/disturbances.h"

#include <cmath>

#include <gmock/gmock.h>

#include "robot/sim/collision_monitor.h"
#include "robot/sim/fault_catalog.h"
#include "robot/sim/lidar_sensor.h"
#include "tests/unit/robot/sim/driven_world.h"
#include "tests/unit/robot/sim/test_scene.h"

namespace kiln::sim {
namespace {

using ::testing::HasSubstr;

WorldConfig withFault(WorldConfig config, const std::string& fault) {
  const auto parsed = FaultConfig::parse(fault);
  EXPECT_TRUE(parsed.has_value()) << parsed.error();
  config.faults.push_back(*parsed);
  return config;
}

/// Range of one LiDAR ray along the ground plane, from there.
Raycaster::Hit look(const RayScene& scene, const Eigen::Vector3f& from, const Eigen::Vector3f& to) {
  const Raycaster::Ray ray{from, (to - from).normalized(), 100.0F, mask::kLidar};
  Raycaster::Hit hit;
  scene.rays().cast({&ray, 1}, {&hit, 1});
  return hit;
}

TEST(Kidnap, PutsTheRobotElsewhereAndTheWheelsNoticeNothing) {
  DrivenWorld w(withFault(DrivenWorld::nominalWorld(), "kidnap=2.1,0.5,30@1"));
  const BaseState before = *w.wheels.state_;
  w.run(2.5);
  const Pose2 at = projectToGround(w.pose());
  EXPECT_NEAR(at.x_m, 2.1, 0.01);
  EXPECT_NEAR(at.y_m, 0.5, 0.01);
  EXPECT_NEAR(at.yaw_rad, M_PI / 6, 0.01);
  EXPECT_NEAR(std::acos(w.pose().linear()(2, 2)) * 180 / M_PI, 4.0, 0.1);  // on the ramp now
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(w.wheels.state_->wheels[i].drive_angle_rad, before.wheels[i].drive_angle_rad, 0.1);
  }
  EXPECT_LT(std::fabs(w.controller.tracking().X_odom_base.x_m), 0.01);
  const Truth truth = w.world->truth();
  EXPECT_EQ(truth.resets, 0u);
  ASSERT_EQ(truth.kidnaps.size(), 1u);
  EXPECT_NEAR(truth.kidnaps[0].x_m, 2.1, 1e-3);
  EXPECT_TRUE(truth.collisions.empty());
}

TEST(CupboardMoved, StandsInTheWayForPhysicsAndRaysUntilItEnds) {
  WorldConfig config;  // flat: 2 m ahead of the robot
  config.perturbation = {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0};
  DrivenWorld w(withFault(config, "cupboard_moved=-4.9,5.5,90@0:8"));
  w.drive({0.5, 0, 0}, 5.0);
  const Truth truth = w.world->truth();
  ASSERT_FALSE(truth.collisions.empty());
  EXPECT_EQ(truth.collisions[0].b, "cupboard");
  w.run(4.0);
  const auto cupboard = [&]() -> Eigen::Vector3d {
    for (const SolidBox& b : w.world->truth().arena.boxes)
      if (b.name == "cupboard") return b.X_map_box.translation();
    return Eigen::Vector3d::Zero();
  };
  EXPECT_TRUE(cupboard().isApprox(Eigen::Vector3d(7.0, -5.5, 1.0), 1e-6));

  TestScene scene;
  const Eigen::Vector3f from(2, 3, 1.2F), to(2, -3, 1.2F);
  const float beyond = look(*scene.scene, from, to).range;
  std::size_t index = 0;
  while (scene.arena.boxes[index].name != "cupboard") ++index;
  scene.state.moved = MovedBox{index, Eigen::Isometry3d(Eigen::Translation3d(2, 0, 1))};
  scene.scene->update(scene.state);
  EXPECT_NEAR(look(*scene.scene, from, to).range, 3.0 - 0.25, 1e-3);
  scene.state.moved.reset();
  scene.scene->update(scene.state);
  EXPECT_EQ(look(*scene.scene, from, to).range, beyond);
}

TEST(Walkers, WalkAroundThingsAndKeepOutOfTheRobotsWay) {
  const TestScene scene;
  Walkers walkers(scene.arena, 5, 6);
  const Eigen::Vector2d robot(8.5, 0.5);
  for (int i = 0; i < 300; ++i) walkers.step(0.01, robot);  // whoever stood there has left
  auto last = walkers.feet();
  double walked = 0.0;
  for (int i = 0; i < 12000; ++i) {
    walkers.step(0.01, robot);
    const auto feet = walkers.feet();
    for (std::size_t k = 0; k < feet.size(); ++k) {
      const double stride = (feet[k] - last[k]).norm();
      walked += stride;
      ASSERT_LE(stride, 1.1 * 0.01 + 1e-9);
      ASSERT_GT((feet[k].head<2>() - robot).norm(), 1.6);
      for (const SolidBox& b : scene.arena.boxes) {
        if (!b.solid || b.name == "door lintel") continue;
        const Eigen::Vector3d q = b.X_map_box.inverse() * feet[k];
        ASSERT_FALSE((q.head<2>().cwiseAbs().array() < 0.5 * b.size_m.head<2>().array()).all())
            << b.name;
      }
    }
    last = feet;
  }
  EXPECT_GT(walked, 6 * 120 * 0.3);  // 120 s; they rest and wait at times
}

TEST(Walkers, AreSeenByTheLidarOnlyWhileTheyAreThere) {
  WorldConfig config;
  TestScene scene;
  scene.config.faults = withFault(config, "people=1@0").faults;
  RayScene rays(scene.config, scene.arena, scene.robot, false);
  const Eigen::Vector3f from(2, 3, 1.0F), to(2, -3, 1.0F);
  scene.state.people = {{2, 0, 0}};
  rays.update(scene.state);
  const auto hit = look(rays, from, to);
  EXPECT_EQ(RayScene::material(hit), Material::Person);
  EXPECT_NEAR(hit.range, 3.0 - 0.22, 0.005);
  EXPECT_FALSE(look(rays, {2, 3, 1.9F}, {2, -3, 1.9F}).valid());  // over the head
  scene.state.people.clear();
  rays.update(scene.state);
  EXPECT_NE(RayScene::material(look(rays, from, to)), Material::Person);
}

TEST(PersonInWay, StepsToThePlaceStandsThereAndStepsBack) {
  auto world = std::move(*World::create(withFault({}, "person_in_way=6.6,0@1:3"), 1));
  const auto peopleAt = [&](double t_s) {
    (void)world->advance(Stamp{fromSeconds(t_s)});
    return world->truth().people;
  };
  EXPECT_TRUE(peopleAt(0.9).empty());
  const auto stepping = peopleAt(1.5);
  ASSERT_EQ(stepping.size(), 1u);
  EXPECT_GT(stepping[0].y(), 1.0);
  const auto standing = peopleAt(3.5);
  ASSERT_EQ(standing.size(), 1u);
  EXPECT_NEAR((standing[0] - Eigen::Vector3d(6.6, 0, 0)).norm(), 0.0, 1e-9);
  EXPECT_TRUE(peopleAt(6.5).empty());
}

TEST(ViewBlocked, HidesHalfOfTheScanAndOnlyFromTheLidar) {
  const auto scanOf = [](const WorldConfig& config) {
    auto world = std::move(*World::create(config, 1));
    WorldCommands c;
    c.sensors = SensorRequest{true, false, false};
    world->command(c);
    return world->advance(world->now() + fromSeconds(0.5)).lidar.back();
  };
  const PointCloudPtr open = scanOf({}), blocked = scanOf(withFault({}, "view_blocked=90@0"));
  const auto farPoints = [](const PointCloud& scan, double side) {
    int n = 0;
    for (std::size_t i = 0; i < scan.size(); ++i)
      if (side * scan.y[i] > 0.05 && std::hypot(scan.x[i], scan.y[i]) > 0.8) ++n;
    return n;
  };
  EXPECT_GT(farPoints(*open, 1.0), 1000);
  EXPECT_EQ(farPoints(*blocked, 1.0), 0);  // azimuth 90 deg: the left half
  EXPECT_NEAR(farPoints(*blocked, -1.0), farPoints(*open, -1.0), 0.02 * farPoints(*open, -1.0));
}

TEST(Runaway, DrivesFasterThanAskedAndZeroStillMeansZero) {
  WorldConfig config;
  DrivenWorld w(withFault(config, "runaway=2.5@3"));
  w.drive({0.2, 0, 0}, 2.0);
  EXPECT_NEAR(w.controller.tracking().measured.vx_mps, 0.2, 0.01);
  w.drive({0.2, 0, 0}, 2.0);
  // 2.5 x 0.2 m/s, less what the controller's trim of 0.05 m/s takes off before the faulty drive.
  EXPECT_NEAR(w.controller.tracking().measured.vx_mps, 2.5 * 0.15, 0.02);
  w.stop.set("test", w.world->now());
  w.run(1.5);
  EXPECT_NEAR(w.controller.tracking().measured.vx_mps, 0.0, 0.01);
}

TEST(Runaway, WithAnOffsetOnlySilenceStopsIt) {
  DrivenWorld w(withFault({}, "runaway=1,0.4@1"));
  w.drive({0, 0, 0}, 3.0);
  EXPECT_NEAR(w.controller.tracking().measured.vx_mps, 0.4 - 0.05, 0.02);
  // After STOP zero does not help either: setpoints are withheld, the device's own watchdog brakes.
  w.stop.set("test", w.world->now());
  w.run(2.0);
  EXPECT_NEAR(w.wheels.state_->wheels[0].drive_radps, 0.0, 0.05);
}

TEST(FireBoxMisplaced, StandsThatFarOffInEverySeedAndTheOtherOneWithinItsTolerance) {
  const TestScene scene;
  const WorldConfig config = withFault({}, "fire_box_misplaced=0.25@0");
  double sum_x = 0.0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const TrueArena arena = TrueArena::draw(config, scene.map, scene.site, scene.robot, seed);
    for (std::size_t i = 0; i < arena.fire_places.size(); ++i) {
      const auto& spot = scene.site.places[i].plate_xyz_m;
      const Eigen::Vector2d off =
          (arena.fire_places[i].X_map_front * Eigen::Vector3d(-scene.site.recess_m, 0, 0))
              .head<2>() -
          Eigen::Vector2d(spot[0], spot[1]);
      if (i == arena.burning) {
        EXPECT_NEAR(off.norm(), 0.25, 1e-9);
        sum_x += off.x();
      } else {
        EXPECT_LE(off.cwiseAbs().maxCoeff(), 0.10);
      }
    }
  }
  EXPECT_LT(std::fabs(sum_x) / 20, 0.12);  // no favoured direction
}

TEST(CollisionMonitor, WheelsMayTouchRampAndEdgeAndTheChassisMayNot) {
  CollisionMonitor monitor(5.0);
  BodyContact wheel;
  wheel.a = "wheel front left";
  wheel.b = "floor ramp";
  wheel.wheel = wheel.floor = true;
  wheel.normal_n = 400.0;
  BodyContact deck = wheel;
  deck.a = "base deck";
  deck.wheel = false;
  monitor.observe(Stamp{}, {wheel});
  EXPECT_TRUE(monitor.collisions().empty());
  monitor.observe(Stamp{}, {wheel, deck});
  ASSERT_EQ(monitor.collisions().size(), 1u);
  EXPECT_EQ(monitor.collisions()[0].a, "base deck");
}

TEST(FaultConfig, ReadsNumbersAndFillsInTheRest) {
  const auto fault = FaultConfig::parse("kidnap=-0.5,2@12:3");
  ASSERT_TRUE(fault.has_value()) << fault.error();
  EXPECT_EQ(fault->name, "kidnap");
  EXPECT_DOUBLE_EQ(fault->at_s, 12.0);
  EXPECT_DOUBLE_EQ(faultValue(*fault, 0), -0.5);
  EXPECT_DOUBLE_EQ(faultValue(*fault, 1), 2.0);
  EXPECT_DOUBLE_EQ(faultValue(*fault, 2), 0.0);
  EXPECT_DOUBLE_EQ(faultValue(*FaultConfig::parse("people@3"), 0), 2.0);
}

TEST(FaultConfig, RefusesNumbersThatMakeNoSense) {
  for (const char* bad :
       {"kidnap=@1", "kidnap=1,@1", "kidnap=a@1", "kidnap=nan@1", "kidnap=1,2,3,4@1",
        "pump_blocked=1@1", "=1@1", "fire_box_misplaced=0.2@5"}) {
    EXPECT_FALSE(FaultConfig::parse(bad).has_value()) << bad;
  }
  EXPECT_THAT(FaultConfig::parse("kidnap=1,2,3,4@1").error().message, HasSubstr("YAW_DEG"));
  EXPECT_THAT(faultHelp(), HasSubstr("people[=COUNT]"));
}

}  // namespace
}  // namespace kiln::sim
