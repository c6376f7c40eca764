#include "robot/skills/macro_runner.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/core/clock.h"
#include "robot/safety/dead_man.h"
#include "tests/unit/robot/skills/macro_steps_for_tests.h"

namespace kiln {
namespace {

using ::testing::HasSubstr;

class MacroRunnerTest : public ::testing::Test {
 protected:
  /// @param steps  YAML: "{ do: wait, seconds: 1 }"
  void make(const std::vector<std::string>& steps, const std::string& place = "") {
    std::string yaml = "name: try\nsteps:\n";
    for (const std::string& step : steps) yaml += "  - " + step + "\n";
    Macro macro;
    const ConfigNode root{[&](ConfigArchive& a) { macro.visit(a, testSteps(robot, arm, light)); }};
    const auto read = loadYamlText(yaml, "try.yaml", root);
    ASSERT_TRUE(read.has_value()) << read.error();
    macro.place = place;
    std::vector<Macro> macros;
    macros.push_back(std::move(macro));
    runner.emplace(
        MacroRunner::Parts{[this] { return base; },
                           [](const std::string& name) {
                             return name == "shelf" ? std::optional(Pose2{2, 1, 0}) : std::nullopt;
                           },
                           [this] { return epoch; }},
        std::move(macros));
  }
  /// One mission tick as the daemon does it.
  void tick(bool held) {
    clock.advanceBy(std::chrono::milliseconds(20));
    hold.expire(clock.now());
    if (held) {
      if (hold.mayFeed(command())) {
        hold.feed(command(), clock.now());
        runner->hold("try", restart, clock.now());
        if (!runner->running()) hold.end(HoldKind::Macro);
      }
    } else {
      hold.releaseAll();
      ++press;
    }
    runner->poll(clock.now(), hold.held(HoldKind::Macro, clock.now()));
    if (!runner->running()) hold.end(HoldKind::Macro);
    if (light) lit_s += 0.02;
  }
  [[nodiscard]] Command command() const {
    Command command;
    command.client_id = "anna";
    command.press = press;
    command.body = HoldMacro{"try", restart};
    return command;
  }
  void run(double seconds, bool held = true) {
    for (double t = 0.0; t < seconds; t += 0.02) tick(held);
  }

  DeadMan hold{DeadMan::Config{}};  ///< says whether the press still counts
  std::uint64_t press = 1;
  ManualClock clock{Stamp{std::chrono::seconds(10)}};
  RobotGeometry robot;
  Pose2 base{2, 1, 0};
  ScriptedArm arm;
  bool light = false;
  double lit_s = 0.0;
  std::uint64_t epoch = 1;
  bool restart = false;
  std::optional<MacroRunner> runner;
};

TEST_F(MacroRunnerTest, RunsItsStepsInOrderAndIsDone) {
  make({"{ do: arm, pose: park }", "{ do: light, seconds: 2, colour: red }",
        "{ do: wait, seconds: 0.5 }"});
  run(0.2);
  EXPECT_EQ(runner->status().running, "try");
  EXPECT_EQ(runner->status().step, 1);
  run(1.5);
  EXPECT_TRUE(light);
  EXPECT_EQ(runner->status().step, 2);
  run(2.0);
  EXPECT_FALSE(runner->running());
  EXPECT_EQ(runner->status().last_result, "done");
  EXPECT_NEAR(lit_s, 2.0, 0.03);
}

TEST_F(MacroRunnerTest, LettingGoAbortsTheStepAtOnce) {
  make({"{ do: arm, pose: park }", "{ do: light, seconds: 10, colour: red }"});
  run(0.3);
  tick(false);
  EXPECT_EQ(arm.cancels, 1);
  EXPECT_FALSE(runner->running());
  run(3.0);  // held again: on with the step
  EXPECT_TRUE(light);
  tick(false);
  EXPECT_FALSE(light);
  EXPECT_EQ(runner->status().last_result, "cancelled: released");
}

TEST_F(MacroRunnerTest, HeldAgainItGoesOnWithTheInterruptedStepOrRestarts) {
  make({"{ do: arm, pose: park }", "{ do: wait, seconds: 5 }"});
  run(1.0);
  EXPECT_EQ(arm.starts, 1);
  tick(false);
  run(0.5);
  EXPECT_EQ(runner->status().step, 2);
  EXPECT_EQ(arm.starts, 1);
  tick(false);
  restart = true;
  tick(true);
  EXPECT_EQ(runner->status().step, 1);
  EXPECT_EQ(arm.starts, 2);
}

TEST_F(MacroRunnerTest, ManyPressesOnAJitteryLinkMakeTheStepNoLonger) {
  make({"{ do: light, seconds: 4, colour: red }"});
  while (runner->status().last_result != "done" && clock.now() < Stamp{std::chrono::seconds(60)}) {
    run(0.7);
    tick(false);
    run(0.3, false);
  }
  EXPECT_EQ(runner->status().last_result, "done");
  EXPECT_NEAR(lit_s, 4.0, 0.2);
}

TEST_F(MacroRunnerTest, RestartedStepBeginsAtItsBeginning) {
  make({"{ do: light, seconds: 2, colour: red }"});
  run(1.5);
  tick(false);
  restart = true;
  lit_s = 0.0;
  run(3.0);
  EXPECT_NEAR(lit_s, 2.0, 0.03);
}

TEST_F(MacroRunnerTest, EndedMacroStartsAnewOnlyAfterLettingGo) {
  make({"{ do: wait, seconds: 0.1 }"});
  run(2.0);
  EXPECT_EQ(runner->status().last_result, "done");
  EXPECT_FALSE(runner->running());
  tick(false);
  tick(true);
  EXPECT_TRUE(runner->running());
}

TEST_F(MacroRunnerTest, SafetyEpochEndsIt) {
  make({"{ do: light, seconds: 10, colour: red }"});
  run(1.0);
  ++epoch;  // STOP or a change of the lease
  tick(true);
  EXPECT_FALSE(runner->running());
  EXPECT_FALSE(light);
  EXPECT_THAT(runner->status().last_result, HasSubstr("control changed"));
  run(1.0);  // the key is still down: nothing comes back by itself
  EXPECT_FALSE(runner->running());
}

TEST_F(MacroRunnerTest, FailedStepFailsTheMacroInWords) {
  make({"{ do: arm, pose: park }"});
  arm.fail = "contact of 70 N at the tool";
  run(0.2);
  EXPECT_THAT(runner->status().last_result, HasSubstr("arm to park: contact of 70 N"));
}

TEST_F(MacroRunnerTest, RefusesToStartAwayFromItsPlace) {
  make({"{ do: wait }"}, "shelf");
  base.x_m += 0.4;
  run(0.2);
  EXPECT_FALSE(runner->running());
  EXPECT_THAT(runner->status().last_result, HasSubstr("0.40 m"));
  base.x_m -= 0.4;
  run(0.2);
  EXPECT_FALSE(runner->running());  // only after letting go
  tick(false);
  tick(true);
  EXPECT_TRUE(runner->running());
}

TEST_F(MacroRunnerTest, UnknownNamesAreSaid) {
  make({"{ do: wait }"}, "attic");
  runner->hold("dance", false, clock.now());
  EXPECT_THAT(runner->status().last_result, HasSubstr("no macro 'dance'"));
  runner->hold("try", false, clock.now());
  EXPECT_THAT(runner->status().last_result, HasSubstr("no place 'attic'"));
}

TEST_F(MacroRunnerTest, ToolStepBringsTheToolToItsPose) {
  make({"{ do: tool, xyz_m: [1, 0.5, 0.8], yaw_deg: 90, pitch_deg: 0 }"});
  run(0.1);
  EXPECT_NEAR((arm.X_goal.translation() - Eigen::Vector3d(1, 0.5, 0.8)).norm(), 0.0, 1e-9);
  EXPECT_NEAR((arm.X_goal.linear().col(0) - Eigen::Vector3d::UnitY()).norm(), 0.0, 1e-9);
}

TEST_F(MacroRunnerTest, ListTellsDurationUseAndStartCondition) {
  make({"{ do: arm, pose: park }", "{ do: light, seconds: 30, colour: red }"}, "shelf");
  const auto info = runner->list().at(0);
  EXPECT_NEAR(info.duration_s, 6.0 + 30.0, 1e-9);
  EXPECT_EQ(info.uses, "est. 3.0 l");
  EXPECT_THAT(info.start_condition, HasSubstr("shelf"));
}

}  // namespace
}  // namespace kiln
