#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/config/resources.h"
#include "common/core/check.h"
#include "common/core/units.h"
#include "robot/missions/fire/macro_steps.h"
#include "robot/missions/fire/skills/jet.h"
#include "robot/skills/macro_runner.h"
#include "robot/skills/move_arm.h"
#include "tests/support/fake_devices.h"
#include "tests/unit/robot/missions/fire/fire_rig.h"
#include "tests/unit/robot/planning/arm_motion/bob.h"

namespace kiln {
namespace {

/// The macros of resources/macros on planned arm motion, with the base at one of the work poses.
class ShippedMacros : public ::testing::Test {
 protected:
  ShippedMacros() {
    const auto folder = resourcePath("macros");
    KILN_CHECK(folder.has_value());
    auto kinds = robotMacroSteps({robot, robot.X_flange_nozzle.pose(), skill, {}});
    for (MacroStepKind& kind : fireMacroSteps(context, {})) kinds.push_back(std::move(kind));
    auto macros = loadMacros({*folder, *folder + "/fire"}, kinds);
    KILN_CHECK(macros.has_value(), macros ? "" : macros.error().message);
    runner.emplace(MacroRunner::Parts{[this] { return base; },
                                      [this](const std::string& name) { return workPose(name); },
                                      [] { return std::uint64_t{1}; }},
                   std::move(*macros));
    for (int i = 0; i < 10; ++i) tick();
  }
  void tick() {
    clock.advanceBy(std::chrono::milliseconds(4));
    arm.advance();
    tank.advance();
    if (++ticks % 2 == 0) controller.tick(clock.now());
    if (ticks % 2 == 0) pumps.tick(clock.now());
    if (ticks % 5 != 0 || name.empty()) return;
    runner->hold(name, false, clock.now());
    runner->poll(clock.now(), true);
    if (pumps.tracking().spraying) watchJet();
  }
  std::string run(const std::string& macro, double limit_s) {
    name = macro;
    for (double t = 0.0; t < limit_s; t += 0.004) {
      tick();
      if (!runner->running() && t > 0.1) break;
    }
    name.clear();
    const bool running = runner->running();
    runner->poll(clock.now(), false);  // lets go
    return running ? "still running" : runner->status().last_result;
  }
  [[nodiscard]] std::optional<Pose2> workPose(const std::string& name) const {
    const FirePlaceConfig* known = site.place(name);
    return known ? std::optional(known->work_pose.pose()) : std::nullopt;
  }
  /// Where the jet crosses the opening of the place in front.
  void watchJet() {
    const Eigen::Isometry3d X_map_nozzle =
        toIsometry(base) * robot.X_base_flange(arm.state()->q) * robot.X_flange_nozzle.pose();
    const double yaw = place->facing_deg * kDeg;
    const Eigen::Vector3d normal(std::cos(yaw), std::sin(yaw), 0.0);
    const Eigen::Vector3d plate(place->plate_xyz_m[0], place->plate_xyz_m[1],
                                place->plate_xyz_m[2]);
    const JetMiss miss =
        jetMiss(calibration, X_map_nozzle, plate + site.recess_m * normal, normal, 1.0);
    worst_miss_m = std::max(worst_miss_m, miss.reaches ? miss.distance_m : 1.0);
  }

  ManualClock clock{Stamp{std::chrono::seconds(10)}};
  RobotGeometry robot = loadBob();
  ArenaMap arena = loadKitchen();
  FireSiteMap site = loadKitchenSite();
  const FirePlaceConfig* place = &site.places[0];
  Pose2 base = place->work_pose.pose();
  SprayCalibration calibration;
  FakeArm arm{clock, robot, RobotGeometry::radians(robot.q_drive_deg)};
  FakePumps tank{clock};
  StopLatch stop;
  ArmController controller{{}, robot, arm, stop};
  PumpController pumps{{}, tank, stop};
  MoveArm skill{{}, robot, arena, controller, arm, [this] { return base; }};
  FakeBaseMotion drive{base};
  FakeHeatSweep sweep;
  FakePlaceLook place_look{clock};
  RobotBelief belief;
  ManualExecutor executor{clock};
  FireContext context{{{clock,
                        executor,
                        arena,
                        robot,
                        belief,
                        drive,
                        skill,
                        arm,
                        pumps,
                        [this] { return base; },
                        {},
                        [](Stamp) { return std::nullopt; },
                        [](Stamp) { return std::nullopt; },
                        [](const ThermalImagePtr&) {},
                        [](const MissionDetail&) {}},
                       sweep,
                       place_look,
                       site,
                       calibration},
                      {}};
  std::optional<MacroRunner> runner;
  std::string name;
  double worst_miss_m = 0.0;
  int ticks = 0;
};

TEST_F(ShippedMacros, SprayFire1HitsTheOpeningAllTheTime) {
  EXPECT_EQ(run("spray fire 1", 120.0), "done");
  EXPECT_LT(worst_miss_m,
            0.075 + 0.02);  // the opening's half width, and what the pattern adds in its corners
  EXPECT_GT(tank.trueLitres(), 1.5);
  EXPECT_EQ(run("arm park", 60.0), "done");
}

TEST_F(ShippedMacros, SprayFire2HitsTheOpeningAllTheTime) {
  place = &site.places[1];
  base = place->work_pose.pose();
  EXPECT_EQ(run("spray fire 2", 120.0), "done");
  EXPECT_LT(worst_miss_m, 0.075 + 0.02);
  EXPECT_GT(tank.trueLitres(), 1.5);
}

TEST_F(ShippedMacros, ArmMacrosReachTheirPoses) {
  for (const char* macro : {"arm look", "arm park", "arm drive"}) {
    EXPECT_EQ(run(macro, 60.0), "done") << macro;
  }
  EXPECT_LT((arm.state()->q - RobotGeometry::radians(robot.q_drive_deg)).norm(), 0.02);
}

}  // namespace
}  // namespace kiln
