#include "robot/skills/bricks/place_brick.h"

#include <cmath>

#include "tests/unit/robot/skills/bricks/fake_handling.h"

namespace kiln {
namespace {

class PlaceBrickTest : public ::testing::Test {
 protected:
  PlaceBrickTest() {
    brick.name = "red 1";
    brick.X_tool_brick.linear() =
        Eigen::AngleAxisd(M_PI, Eigen::Vector3d::UnitX()).toRotationMatrix();
    brick.X_tool_brick.translation() << 0.01, 0, 0.1;
    f.gripper.on.set();
    f.gripper.contact = true;
  }
  /// Where the brick hangs now: a slot that the arm, which stands still here, has reached.
  Eigen::Isometry3d here() const {
    return f.robot.X_base_flange(f.arm.trueQ()) * f.robot.X_flange_tool.pose() * brick.X_tool_brick;
  }
  SkillStatus run(std::vector<std::string> endings, const Eigen::Isometry3d& X_base_slot,
                  std::optional<Eigen::Vector3d> towards = std::nullopt) {
    f.motion.endings.assign(endings.begin(), endings.end());
    place.start({brick, X_base_slot, {}, towards, {}}, f.clock.now());
    return f.work(place, 200.0, [&] { f.gripper.contact = f.gripper.on.any() || stuck; });
  }

  FakeHandling f;
  HeldBrick brick;
  PlaceBrick place{{}, f.parts};
  bool stuck = false;
};

TEST_F(PlaceBrickTest, LowersUntilItFeelsLetsGoAndTellsTheArm) {
  const SkillStatus status = run({"", "", "contact", ""}, here());
  ASSERT_EQ(status.phase, SkillPhase::Done) << status.failure_code << ": " << status.text;
  EXPECT_TRUE(f.gripper.on.none());
  EXPECT_NEAR(f.arm.payloads().back().mass_kg, 5.0, 1e-9);
  ASSERT_TRUE(place.placement().has_value());
  EXPECT_TRUE(place.placement()->X_base_brick.isApprox(here(), 1e-6));
  EXPECT_TRUE(f.motion.under[0].carried.has_value());
  EXPECT_FALSE(f.motion.under.back().carried.has_value());
  EXPECT_FALSE(f.motion.terms.carried.has_value());
  const Eigen::Vector3d up =
      f.motion.goals.back().translation() - place.placement()->X_base_flange.translation();
  EXPECT_NEAR(up.z(), 0.12, 1e-3) << "straight up";
  EXPECT_LT(up.head<2>().norm(), 5e-3);
}

TEST_F(PlaceBrickTest, GoesToTheNeighbourOffItsSupportAndBackByTheJoint) {
  const Eigen::Vector3d towards = Eigen::Vector3d::UnitY();
  const SkillStatus status =
      run({"", "", "contact", "", "contact", "", "contact", ""}, here(), towards);
  ASSERT_EQ(status.phase, SkillPhase::Done) << status.failure_code << ": " << status.text;
  EXPECT_TRUE(place.placement()->neighbour_felt);
  ASSERT_EQ(f.motion.goals.size(), 8U);
  const Eigen::Vector3d now = place.placement()->X_base_flange.translation();
  EXPECT_NEAR((f.motion.goals[3].translation() - now).z(), 0.004, 1e-4);
  EXPECT_NEAR((f.motion.goals[4].translation() - now).y(), 0.04, 1e-4);
  EXPECT_NEAR((f.motion.goals[5].translation() - now).y(), -0.003, 1e-4);
  EXPECT_LT(*f.motion.under[4].guard_force_n, 6.0) << "far below what the magnets bear sideways";
}

TEST_F(PlaceBrickTest, NoSupportIsNoContactAndTheBrickStaysHeld) {
  const SkillStatus status = run({"", "", ""}, here());
  EXPECT_EQ(status.failure_code, "no_contact") << status.text;
  EXPECT_TRUE(f.gripper.on.all());
  EXPECT_FALSE(place.placement().has_value());
}

TEST_F(PlaceBrickTest, WhatIsMetAboveTheSlotIsNoSupport) {
  Eigen::Isometry3d below = here();
  below.translation().z() -= 0.05;
  const SkillStatus status = run({"", "", "contact"}, below);
  EXPECT_EQ(status.failure_code, "contact") << status.text;
  EXPECT_NE(status.text.find("50 mm above"), std::string::npos) << status.text;
  EXPECT_TRUE(f.gripper.on.all());
}

TEST_F(PlaceBrickTest, ABrickThatComesAlongIsNotReleased) {
  stuck = true;
  f.motion.endings = {"", "", "contact", "never"};
  place.start({brick, here(), {}, std::nullopt, {}}, f.clock.now());
  const SkillStatus status = f.work(place, 60.0, [&] {
    if (f.motion.goals.size() != 4) return;
    f.arm.jam(true);  // the test moves it
    Vector6d q = f.arm.trueQ();
    q[1] += 0.002;  // leaves
    f.arm.setQ(q);
  });
  EXPECT_EQ(status.failure_code, "not_released") << status.text;
}

TEST_F(PlaceBrickTest, ADropOnTheWayIsKnownWithin300Ms) {
  f.motion.endings = {"never"};
  place.start({brick, here(), {}, std::nullopt, {}}, f.clock.now());
  const Stamp fall = f.clock.now() + fromSeconds(1.0);
  const SkillStatus status = f.work(place, 60.0, [&] { f.gripper.contact = f.clock.now() < fall; });
  EXPECT_EQ(status.failure_code, "dropped") << status.text;
  EXPECT_LE(toSeconds(place.drop()->noticed - fall), 0.3);
}

TEST_F(PlaceBrickTest, AProtectiveStopKeepsTheBrick) {
  f.motion.endings = {"never"};
  place.start({brick, here(), {}, std::nullopt, {}}, f.clock.now());
  int polls = 0;
  const SkillStatus status = f.work(place, 60.0, [&] {
    if (++polls == 20) f.arm.setSafety(ArmSafetyMode::ProtectiveStop);
  });
  EXPECT_EQ(status.failure_code, "protective_stop");
  EXPECT_NE(status.text.find("red 1"), std::string::npos) << status.text;
  f.run(3.0);
  EXPECT_EQ(place.poll(f.clock.now()).failure_code, "protective_stop");
  EXPECT_TRUE(f.gripper.on.all());
  EXPECT_EQ(f.motion.goals.size(), 1U);
  EXPECT_NEAR(f.arm.payloads().back().mass_kg, 6.0, 1e-9) << "the arm still carries it";
}

TEST_F(PlaceBrickTest, SaysWhyItCannotGetThereAndEndsAfterItsTime) {
  f.motion.refused = Error{ErrorCode::Degenerate, "no arm posture reaches the pose"};
  EXPECT_EQ(run({}, here()).failure_code, "unreachable");
  f.motion.refused = Error{ErrorCode::Refused, "the pose is too near: held red 1 to green 2"};
  EXPECT_EQ(run({}, here()).failure_code, "in_collision");
  f.motion.refused.reset();
  EXPECT_EQ(run({"in_collision", "in_collision"}, here()).failure_code, "in_collision");
  EXPECT_EQ(run({"never"}, here()).failure_code, "timeout");
  EXPECT_EQ(run({"stopped"}, here()).failure_code, "stopped");
  EXPECT_TRUE(f.gripper.on.all());
}

class HeldBrickWatchTest : public PlaceBrickTest {
 protected:
  /// 50 Hz for so long. @return seconds until it was noticed; negative: it was not.
  double watched(double seconds, const std::function<void(double)>& happens) {
    const Stamp from = f.clock.now();
    while (toSeconds(f.clock.now() - from) < seconds) {
      for (int i = 0; i < 5; ++i) f.step();
      happens(toSeconds(f.clock.now() - from));
      drop = watch.poll(f.gripper.state(), f.arm.state(), f.clock.now());
      if (drop) return toSeconds(f.clock.now() - from);
    }
    return -1.0;
  }
  HeldBrickWatch watch{{}, f.robot};
  std::optional<BrickDrop> drop;
};

TEST_F(HeldBrickWatchTest, AnOpenSwitchIsADropAndASingleSampleIsNone) {
  watch.begin(brick, f.clock.now());
  EXPECT_LT(watched(1.0, [&](double t) { f.gripper.contact = std::lround(t / 0.02) % 10 != 0; }), 0)
      << "the switch bounces";
  const double t = watched(1.0, [&](double) { f.gripper.contact = false; });
  EXPECT_GT(t, 0.0);
  EXPECT_LE(t, 0.3);
  EXPECT_EQ(drop->name, "red 1");
  EXPECT_FALSE(watch.poll(f.gripper.state(), f.arm.state(), f.clock.now()).has_value()) << "once";
}

TEST_F(HeldBrickWatchTest, AMissingWeightIsADropThoughTheSwitchIsStuck) {
  watch.begin(brick, f.clock.now());
  EXPECT_LT(watched(1.0, [&](double t) { f.arm.setForce({3, 2, 3 * std::sin(30 * t)}); }), 0);
  const double t = watched(1.0, [&](double) { f.arm.setForce({0, 0, 9.81}); });
  EXPECT_GT(t, 0.0);
  EXPECT_LE(t, 0.3);
  EXPECT_NE(drop->why.find("missing"), std::string::npos) << drop->why;
}

TEST_F(HeldBrickWatchTest, WhatASupportCarriesIsNoDrop) {
  watch.begin(brick, f.clock.now());
  watch.setSupported(true);
  EXPECT_LT(watched(1.0, [&](double) { f.arm.setForce({0, 0, 15}); }), 0);
}

TEST_F(HeldBrickWatchTest, AnOldStateSaysNothing) {
  watch.begin(brick, f.clock.now());
  (void)f.gripper.state();
  f.gripper.stands = true;
  f.gripper.contact = false;
  EXPECT_TRUE(watch.blind(f.gripper.state(), f.clock.now() + fromSeconds(0.2)).empty());
  EXPECT_FALSE(watch.blind(f.gripper.state(), f.clock.now() + fromSeconds(0.4)).empty());
}

}  // namespace
}  // namespace kiln
