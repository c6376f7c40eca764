#include "robot/skills/bricks/pick_brick.h"

#include "tests/unit/robot/skills/bricks/fake_handling.h"

namespace kiln {
namespace {

class PickBrickTest : public ::testing::Test {
 protected:
  static PickBrick::Config config(int tries) {
    PickBrick::Config out;
    out.max_tries = tries;
    return out;
  }
  /// The switch closes with the magnets.
  SkillStatus run(PickBrick& skill, std::vector<std::string> endings, bool sticks = true) {
    f.motion.endings.assign(endings.begin(), endings.end());
    skill.start({f.red(), {}, {}, 0.0}, f.clock.now());
    return f.work(skill, 100.0, [&] { f.gripper.contact = sticks && f.gripper.on.any(); });
  }

  FakeHandling f;
  PickBrick pick{config(1), f.parts};
};

TEST_F(PickBrickTest, GripsWeighsAndLiftsAndTellsTheArm) {
  f.arm.setForce({3, 0, -2});  // what the sensor is off
  const int zeroed = f.arm.zeroings();
  const SkillStatus status = run(pick, {"", "contact", "", ""});
  ASSERT_EQ(status.phase, SkillPhase::Done) << status.failure_code << ": " << status.text;
  EXPECT_EQ(f.arm.zeroings(), zeroed + 1) << "before the approach, at rest";
  EXPECT_NEAR(f.arm.payloads().back().mass_kg, 6.0, 1e-9);
  EXPECT_NEAR(pick.held()->weighed_kg, 1.0, 0.01);
  ASSERT_EQ(f.motion.goals.size(), 4U);
  EXPECT_NEAR(f.motion.goals[0].translation().z() - f.motion.goals[1].translation().z(), 0.065,
              1e-9)
      << "4.5 cm before the plate to 2 cm beyond";
  EXPECT_FALSE(f.motion.under[0].carried.has_value());
  EXPECT_TRUE(f.motion.under[2].carried.has_value()) << "planned with the brick in hand";
  EXPECT_TRUE(f.motion.terms.carried.has_value()) << "whoever moves the arm next, too";
  EXPECT_LE(*f.motion.under[1].guard_force_n, 15.0);
}

TEST_F(PickBrickTest, NothingFeltIsNoContact) {
  const SkillStatus status = run(pick, {"", "", ""});
  EXPECT_EQ(status.failure_code, "no_contact") << status.text;
  EXPECT_TRUE(f.gripper.on.none());
}

TEST_F(PickBrickTest, ASwitchThatStaysOpenIsNoContactAndTheMagnetsGoOff) {
  const SkillStatus status = run(pick, {"", "contact", ""}, false);
  EXPECT_EQ(status.failure_code, "no_contact") << status.text;
  EXPECT_TRUE(f.gripper.on.none());
  EXPECT_FALSE(pick.held().has_value());
}

TEST_F(PickBrickTest, TriesAgainBesideABoundedNumberOfTimes) {
  PickBrick three(config(3), f.parts);
  const SkillStatus status = run(three, {});
  EXPECT_EQ(status.failure_code, "no_contact") << status.text;
  EXPECT_EQ(three.tries(), 3);
  ASSERT_EQ(f.motion.goals.size(), 9U);  // above, down, back: three times
  for (const auto& [a, b] : {std::pair{0, 3}, std::pair{3, 6}, std::pair{0, 6}}) {
    const Eigen::Vector3d beside = f.motion.goals[static_cast<std::size_t>(b)].translation() -
                                   f.motion.goals[static_cast<std::size_t>(a)].translation();
    EXPECT_GT(beside.norm(), 0.01);
    EXPECT_LT(beside.norm(), 0.04);
    EXPECT_NEAR(beside.z(), 0.0, 1e-9);
  }
}

TEST_F(PickBrickTest, WhatWeighsTooLittleIsLaidBackAndNotHeld) {
  f.motion.endings = {"", "contact", "", "contact", ""};
  pick.start({f.red(), {}, {}, 0.0}, f.clock.now());
  const SkillStatus status = f.work(pick, 60.0, [&] {
    f.gripper.contact = f.gripper.on.any();
    f.arm.setForce({0, 0, f.arm.payloads().back().mass_kg > 5.5 ? 9.0 : 0.0});
  });
  EXPECT_EQ(status.failure_code, "not_held") << status.text;
  EXPECT_EQ(f.motion.goals.size(), 5U) << "laid back before the magnets go off";
  EXPECT_TRUE(f.gripper.on.none());
  EXPECT_NEAR(f.arm.payloads().back().mass_kg, 5.0, 1e-9);
}

TEST_F(PickBrickTest, WhatFallsOffTheFirstCentimetresIsNotHeld) {
  f.motion.endings = {"", "contact", "", ""};
  pick.start({f.red(), {}, {}, 0.0}, f.clock.now());
  const SkillStatus status = f.work(
      pick, 60.0, [&] { f.gripper.contact = f.gripper.on.any() && f.motion.goals.size() < 3; });
  EXPECT_EQ(status.failure_code, "not_held") << status.text;
}

TEST_F(PickBrickTest, ADropWhileItIsLiftedIsToldWithName) {
  f.motion.endings = {"", "contact", "", "never"};
  pick.start({f.red(), {}, {}, 0.0}, f.clock.now());
  Stamp fell;
  const SkillStatus status = f.work(pick, 60.0, [&] {
    if (f.motion.goals.size() == 4 && f.gripper.contact) fell = f.clock.now();
    f.gripper.contact = f.gripper.on.any() && f.motion.goals.size() < 4;
  });
  EXPECT_EQ(status.failure_code, "dropped") << status.text;
  ASSERT_TRUE(pick.drop().has_value());
  EXPECT_EQ(pick.drop()->name, "red 1");
  EXPECT_LE(toSeconds(pick.drop()->noticed - fell), 0.3);
  EXPECT_FALSE(pick.held().has_value());
  EXPECT_GE(f.motion.cancels, 1) << "the arm holds";
}

TEST_F(PickBrickTest, SaysWhyItCannotGetThere) {
  f.motion.refused = Error{ErrorCode::Degenerate, "no arm posture reaches the pose"};
  EXPECT_EQ(run(pick, {}).failure_code, "unreachable");
  f.motion.refused = Error{ErrorCode::Refused, "the pose is too near: forearm to green 2"};
  EXPECT_EQ(run(pick, {}).failure_code, "in_collision");
  f.motion.refused.reset();
  f.motion.goals.clear();
  const SkillStatus status = run(pick, {"in_collision", "in_collision"});
  EXPECT_EQ(status.failure_code, "in_collision");
  ASSERT_EQ(f.motion.goals.size(), 2U) << "the other half turn is tried";
  EXPECT_NEAR(rotationAngle(f.motion.goals[0].inverse() * f.motion.goals[1]), M_PI, 1e-6);
}

TEST_F(PickBrickTest, AProtectiveStopKeepsTheMagnetsAndWaits) {
  f.motion.endings = {"", "contact", "never"};
  pick.start({f.red(), {}, {}, 0.0}, f.clock.now());
  const SkillStatus status = f.work(pick, 60.0, [&] {
    f.gripper.contact = f.gripper.on.any();
    if (f.motion.goals.size() == 3) f.arm.setSafety(ArmSafetyMode::ProtectiveStop);
  });
  EXPECT_EQ(status.failure_code, "protective_stop") << status.text;
  f.run(3.0);
  EXPECT_EQ(pick.poll(f.clock.now()).failure_code, "protective_stop");
  EXPECT_TRUE(f.gripper.on.all());
  EXPECT_EQ(f.motion.goals.size(), 3U) << "nothing by itself";
  EXPECT_EQ(f.arm.releases(), 0);
}

TEST_F(PickBrickTest, EndsAfterItsTimeAndWithASilentGripper) {
  EXPECT_EQ(run(pick, {"never"}).failure_code, "timeout");
  f.motion.endings = {"", "contact", "", "never"};
  pick.start({f.red(), {}, {}, 0.0}, f.clock.now());
  const SkillStatus status = f.work(pick, 30.0, [&] {
    f.gripper.contact = f.gripper.on.any();
    f.gripper.stands = f.motion.goals.size() == 5;  // while it is lifted
  });
  EXPECT_EQ(status.failure_code, "timeout") << status.text;
}

TEST_F(PickBrickTest, SaysTheMagnetsAgainToAGripperThatMissedIt) {
  f.gripper.deaf_writes = 2;
  const SkillStatus status = run(pick, {"", "contact", "", ""});
  EXPECT_EQ(status.phase, SkillPhase::Done) << status.failure_code << ": " << status.text;
}

TEST_F(PickBrickTest, AForceSensorThatIsPressedIsNotZeroedAway) {
  f.arm.setForce({0, 0, 40});
  const SkillStatus status = run(pick, {""});
  EXPECT_EQ(status.failure_code, "timeout");
  EXPECT_NE(status.text.find("zeroed"), std::string::npos) << status.text;
}

}  // namespace
}  // namespace kiln
