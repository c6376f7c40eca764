#include "robot/skills/macro_runner.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "robot/safety/dead_man.h"
#include "tests/support/fake_devices.h"
#include "tests/unit/robot/planning/arm_motion/bob.h"

namespace kiln {
namespace {

using ::testing::HasSubstr;

/// An arm whose every motion takes half a second, or fails.
class ScriptedArm final : public ArmMotion {
 public:
  void startJoints(const Vector6d&, Stamp now) override { begin(now); }
  void startPose(const Eigen::Isometry3d&, Stamp now) override { begin(now); }
  void startCartesian(std::vector<Eigen::Isometry3d> poses, bool, Stamp now) override {
    begin(now);
    last_round = poses.size();
  }
  void startBack(double, Stamp now) override { begin(now); }
  SkillStatus poll(Stamp now) override {
    if (!fail.empty()) return {SkillPhase::Failed, 0.0, fail, "contact"};
    if (!moving) return {};
    const double s = toSeconds(now - started) / 0.5;
    if (s >= 1.0) moving = false;
    return {s >= 1.0 ? SkillPhase::Done : SkillPhase::Running, std::min(1.0, s), "", ""};
  }
  void cancel() override {
    moving = false;
    ++cancels;
  }
  Result<Vector6d> check(const Eigen::Isometry3d&) const override {
    return Vector6d::Zero().eval();
  }

  bool moving = false;
  int starts = 0, cancels = 0;
  std::size_t last_round = 0;
  std::string fail;

 private:
  void begin(Stamp now) {
    moving = true;
    started = now;
    ++starts;
  }
  Stamp started;
};

MacroStep step(const char* action, double seconds = 1.0) {
  MacroStep s;
  s.action = action;
  s.seconds = seconds;
  s.pose = "park";
  s.place = "place 1";
  return s;
}

class MacroRunnerTest : public ::testing::Test {
 protected:
  void make(std::vector<MacroStep> steps, const std::string& place = "") {
    Macro macro;
    macro.name = "try";
    macro.place = place;
    macro.steps = std::move(steps);
    runner.emplace(
        MacroRunnerConfig{},
        MacroRunner::Parts{robot, arena, arm, pumps, SprayCalibration{}, [this] { return base; },
                           [] { return std::optional(Eigen::Isometry3d::Identity()); },
                           [this] { return epoch; }},
        std::vector<Macro>{macro});
  }
  /// One mission tick as the daemon does it; control and devices run beside.
  void tick(bool held) {
    for (int i = 0; i < 5; ++i) {
      clock.advanceBy(std::chrono::milliseconds(4));
      device.advance();
      pumps.tick(clock.now());
    }
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
  RobotGeometry robot = loadBob();
  ArenaMap arena = loadKitchen();
  Pose2 base = arena.fire_places[0].work_pose.pose();
  FakePumps device{clock};
  StopLatch stop;
  PumpController pumps{{}, device, stop};
  ScriptedArm arm;
  std::uint64_t epoch = 1;
  bool restart = false;
  std::optional<MacroRunner> runner;
};

TEST_F(MacroRunnerTest, RunsItsStepsInOrderAndIsDone) {
  make({step("arm"), step("spray", 2.0), step("wait", 0.5)});
  run(0.2);
  EXPECT_EQ(runner->status().running, "try");
  EXPECT_EQ(runner->status().step, 1);
  run(1.5);
  EXPECT_TRUE(pumps.tracking().spraying);
  EXPECT_EQ(runner->status().step, 2);
  run(2.0);
  EXPECT_FALSE(runner->running());
  EXPECT_EQ(runner->status().last_result, "done");
  EXPECT_NEAR(device.trueLitres(), 2.0 * 3.2 / 60.0, 0.03);
}

TEST_F(MacroRunnerTest, LettingGoStopsArmAndPumpsAtOnce) {
  make({step("arm"), step("spray", 10.0)});
  run(0.3);
  tick(false);
  EXPECT_EQ(arm.cancels, 1);
  EXPECT_FALSE(runner->running());
  run(3.0);  // held again: on with the step
  EXPECT_TRUE(pumps.tracking().spraying);
  tick(false);
  run(0.1, false);
  EXPECT_EQ(pumps.tracking().duty[0], 0.0);
  EXPECT_EQ(runner->status().last_result, "cancelled: released");
}

TEST_F(MacroRunnerTest, HeldAgainItGoesOnWithTheInterruptedStepOrRestarts) {
  make({step("arm"), step("wait", 5.0)});
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

TEST_F(MacroRunnerTest, EndedMacroStartsAnewOnlyAfterLettingGo) {
  make({step("wait", 0.1)});
  run(2.0);
  EXPECT_EQ(runner->status().last_result, "done");
  EXPECT_FALSE(runner->running());
  tick(false);
  tick(true);
  EXPECT_TRUE(runner->running());
}

TEST_F(MacroRunnerTest, SafetyEpochEndsIt) {
  make({step("spray", 10.0)});
  run(1.0);
  ++epoch;  // STOP or a change of the lease
  tick(true);
  EXPECT_FALSE(runner->running());
  EXPECT_THAT(runner->status().last_result, HasSubstr("control changed"));
  run(1.0);  // the key is still down: nothing comes back by itself
  EXPECT_FALSE(runner->running());
  EXPECT_EQ(pumps.tracking().duty[0], 0.0);
}

TEST_F(MacroRunnerTest, FailedArmAndDryPumpFailTheMacroInWords) {
  make({step("arm")});
  arm.fail = "contact of 70 N at the tool";
  run(0.2);
  EXPECT_THAT(runner->status().last_result, HasSubstr("contact of 70 N"));

  arm.fail.clear();
  ++press;
  make({step("spray", 10.0)});
  device.setDry(0, true);
  run(4.0);
  EXPECT_THAT(runner->status().last_result, HasSubstr("no current"));
  EXPECT_EQ(pumps.tracking().duty[1], 0.0);
}

TEST_F(MacroRunnerTest, RefusesToStartAwayFromItsPlace) {
  make({step("wait")}, "place 1");
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

TEST_F(MacroRunnerTest, UnknownNameIsSaid) {
  make({step("wait")});
  runner->hold("spray fire 9", false, clock.now());
  EXPECT_THAT(runner->status().last_result, HasSubstr("no macro 'spray fire 9'"));
}

TEST_F(MacroRunnerTest, HourglassMovesWhileItSprays) {
  auto spray = step("spray", 3.0);
  spray.pattern = "hourglass";
  make({spray});
  run(2.0);
  EXPECT_GE(arm.starts, 3);  // round after round
  EXPECT_GT(arm.last_round, 4u);
  EXPECT_TRUE(pumps.tracking().spraying);
}

TEST_F(MacroRunnerTest, ListTellsDurationWaterAndStartCondition) {
  auto spray = step("spray", 30.0);
  spray.duty = 0.5;
  make({step("arm"), spray}, "place 1");
  const auto info = runner->list().at(0);
  EXPECT_NEAR(info.duration_s, 6.0 + 30.0, 1e-9);
  EXPECT_EQ(info.uses, "est. 0.8 l") << 2 * 1.6 / 60.0 * 0.5 * 30.0;
  EXPECT_THAT(info.start_condition, HasSubstr("place 1"));
}

}  // namespace
}  // namespace kiln
