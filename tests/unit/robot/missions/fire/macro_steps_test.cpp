#include "robot/missions/fire/macro_steps.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/robot/missions/fire/fire_rig.h"

namespace kiln {
namespace {

using ::testing::HasSubstr;

/// One step of the fire mission on its rig, made from YAML as a macro would.
class FireMacroSteps : public ::testing::Test {
 protected:
  std::unique_ptr<MacroStep> read(const std::string& yaml) {
    Macro macro;
    const auto kinds = rig.mission->macroSteps({});
    const ConfigNode root{[&](ConfigArchive& a) { macro.visit(a, kinds); }};
    const auto loaded = loadYamlText("name: try\nsteps:\n  - " + yaml + "\n", "try.yaml", root);
    const auto valid = loaded ? macro.validate("try.yaml") : loaded;
    problem = valid ? "" : valid.error().message;
    return macro.steps.empty() ? nullptr : std::move(macro.steps.front());
  }
  SkillStatus poll(MacroStep& step, double seconds) {
    SkillStatus status;
    for (double t = 0.0; t < seconds; t += 0.02) {
      rig.run(0.02);
      status = step.poll(rig.clock.now());
      if (status.phase != SkillPhase::Running) break;
    }
    return status;
  }

  FireRig rig{FireRig::Options{.start = false}};
  std::string problem;
};

TEST_F(FireMacroSteps, SpraysAsLongAsItSaysOverAllPresses) {
  const auto step = read("{ do: spray, duty: 0.5, seconds: 4 }");
  ASSERT_EQ(problem, "");
  step->start(rig.clock.now());
  EXPECT_EQ(poll(*step, 2.0).phase, SkillPhase::Running);
  EXPECT_TRUE(rig.pumpsRun());
  step->abort(rig.clock.now());
  rig.run(5.0);
  EXPECT_FALSE(rig.pumpsRun());
  step->resume(rig.clock.now());
  EXPECT_EQ(poll(*step, 1.5).phase, SkillPhase::Running);
  EXPECT_EQ(poll(*step, 1.0).phase, SkillPhase::Done);
  rig.run(1.0);
  EXPECT_FALSE(rig.pumpsRun());
}

TEST_F(FireMacroSteps, DryPumpFailsInWords) {
  const auto step = read("{ do: spray, seconds: 10 }");
  rig.pumps_device.setDry(0, true);
  step->start(rig.clock.now());
  const SkillStatus status = poll(*step, 8.0);
  EXPECT_EQ(status.phase, SkillPhase::Failed);
  EXPECT_THAT(status.text, HasSubstr("no current"));
}

TEST_F(FireMacroSteps, HourglassMovesWhileItSprays) {
  const auto nozzle = read("{ do: nozzle, xyz_m: [1.3, 0.0, 1.1] }");
  ASSERT_EQ(problem, "");
  nozzle->start(rig.clock.now());
  ASSERT_EQ(poll(*nozzle, 20.0).phase, SkillPhase::Done);
  const auto step = read("{ do: spray, seconds: 20, pattern: hourglass, tilt_deg: 4 }");
  step->start(rig.clock.now());
  rig.run(0.1);
  EXPECT_EQ(poll(*step, 3.0).phase, SkillPhase::Running);
  EXPECT_TRUE(rig.pumpsRun());
  EXPECT_TRUE(rig.arm.moving());
}

TEST_F(FireMacroSteps, KeysOfTheirKindAreChecked) {
  read("{ do: spray, seconds: 500 }");
  EXPECT_THAT(problem, HasSubstr("try.yaml:3: 'seconds' is 500 s; allowed 0.1 to 120"));
  read("{ do: spray, duty: .nan }");
  EXPECT_THAT(problem, HasSubstr("'duty'"));
  read("{ do: spray, pattern: steady, tilt_deg: 3 }");
  EXPECT_THAT(problem, HasSubstr("unknown key 'tilt_deg'"));
  read("{ do: aim }");
  EXPECT_THAT(problem, HasSubstr("'place' is missing"));
}

TEST_F(FireMacroSteps, AimFailsWithoutItsPlaceInWords) {
  const auto step = read("{ do: aim, place: attic }");
  step->start(rig.clock.now());
  EXPECT_THAT(step->poll(rig.clock.now()).text, HasSubstr("no fire place 'attic'"));
}

TEST_F(FireMacroSteps, ListTellsTheWater) {
  const auto step = read("{ do: spray, duty: 0.5, seconds: 30 }");
  MacroEstimate estimate;
  step->addTo(estimate);
  EXPECT_NEAR(estimate.uses["l"], 3.2 / 60.0 * 0.5 * 30.0, 1e-9);
  EXPECT_NEAR(estimate.duration_s, 30.0, 1e-9);
}

TEST_F(FireMacroSteps, WorkPoseOfAPlaceFollowsANudge) {
  ASSERT_TRUE(rig.mission->workPose("place 1").has_value());
  EXPECT_FALSE(rig.mission->workPose("attic").has_value());
  const Pose2 before = *rig.mission->workPose("place 1");
  ASSERT_TRUE(rig.mission->nudgePlace("place 1", {0.1, 0.0, 0.0}).has_value());
  const Pose2 after = *rig.mission->workPose("place 1");
  EXPECT_GT(std::hypot(after.x_m - before.x_m, after.y_m - before.y_m), 0.05);
}

}  // namespace
}  // namespace kiln
