// A person at the station against the whole robot, in real time: modes, pause, forced transitions,
// STOP, reset.
#include <cmath>
#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>
#include <unistd.h>

#include "common/config/resources.h"
#include "robot/evaluation/live_system.h"
#include "tests/support/paths.h"

namespace kiln {
namespace {

using std::chrono::seconds;
using View = ScriptedOperator::View;

class OperatorCommands : public testing::Test {
 protected:
  void SetUp() override {
    auto live = LiveSystem::start(3, {}, {}, kiln::binaryDir() + "/bin");
    ASSERT_TRUE(live.has_value()) << live.error();
    live_ = std::move(*live);
    auto person = live_->connectOperator("Ann");
    ASSERT_TRUE(person.has_value()) << person.error();
    person_ = std::move(*person);
    ASSERT_TRUE(waitForWord(StatusWord::Ready)) << person_->view().status->reason;
    ASSERT_TRUE(takeLease());
  }
  testing::AssertionResult waitForWord(StatusWord word) {
    const auto waited =
        person_->waitFor(std::string(toString(word)), seconds(15),
                         [&](const View& v) { return v.status && v.status->word == word; });
    if (waited) return testing::AssertionSuccess();
    return testing::AssertionFailure()
           << waited.error() << "; it is " << toString(person_->view().status->word);
  }
  testing::AssertionResult takeLease() {
    auto taken = person_->command(AcquireLease{});
    if (taken)
      taken = person_->waitFor("the lease", seconds(3), [](const View& v) { return v.lease.mine; });
    return taken ? testing::AssertionSuccess() : testing::AssertionFailure() << taken.error();
  }
  testing::AssertionResult waitForSpeed(bool moving) {
    const auto waited =
        person_->waitFor(moving ? "motion" : "standstill", seconds(10), [&](const View& v) {
          const double speed = std::hypot(v.status->twist.vx_mps, v.status->twist.vy_mps);
          return moving ? speed > 0.1 : speed < 0.01;
        });
    return waited ? testing::AssertionSuccess() : testing::AssertionFailure() << waited.error();
  }
  std::unique_ptr<LiveSystem> live_;
  std::unique_ptr<ScriptedOperator> person_;
};

TEST_F(OperatorCommands, PauseHoldsTheRobotAndResumeGoesOn) {
  ASSERT_TRUE(person_->command(StartMission{}).has_value());
  ASSERT_TRUE(waitForWord(StatusWord::Auto));
  ASSERT_TRUE(waitForSpeed(true));
  ASSERT_TRUE(person_->command(Pause{}).has_value());
  ASSERT_TRUE(waitForWord(StatusWord::Paused));
  ASSERT_TRUE(waitForSpeed(false));
  ASSERT_TRUE(person_->command(Resume{}).has_value());
  ASSERT_TRUE(waitForSpeed(true));
}

TEST_F(OperatorCommands, AForcedTransitionIsComparedWithWhatTheOperatorSaw) {
  ASSERT_TRUE(person_->command(StartMission{}).has_value());
  ASSERT_TRUE(waitForSpeed(true));
  const auto wrong_step = person_->command(ChangeState{"EnterBuilding", 999, "ParkArm"});
  ASSERT_FALSE(wrong_step.has_value());
  EXPECT_EQ(person_->view().last_command->code, "moved") << wrong_step.error();
  const auto nowhere = person_->command(ChangeState{"EnterBuilding", 1, "Nowhere"});
  ASSERT_FALSE(nowhere.has_value());
  EXPECT_EQ(person_->view().last_command->code, "no_such_state");
  const auto forced = person_->command(ChangeState{"EnterBuilding", 1, "ParkArm"});
  EXPECT_TRUE(forced.has_value()) << forced.error();
}

TEST_F(OperatorCommands, StopHaltsLatchesAndClearingMovesNothing) {
  ASSERT_TRUE(person_->command(StartMission{}).has_value());
  ASSERT_TRUE(waitForSpeed(true));
  person_->session().stop();
  ASSERT_TRUE(waitForWord(StatusWord::Stopped));
  ASSERT_TRUE(person_
                  ->waitFor("proof of standstill", seconds(10),
                            [](const View& v) { return v.status->stop.standstill_proven; })
                  .has_value());
  ASSERT_TRUE(takeLease()) << "STOP revokes it";
  EXPECT_FALSE(person_->command(Resume{}).has_value()) << "nothing moves while STOP is latched";
  ASSERT_TRUE(person_->command(ClearStop{person_->view().status->stop.generation}).has_value());
  ASSERT_TRUE(waitForWord(StatusWord::Paused)) << "the mission waits for a word of its own";
  EXPECT_TRUE(waitForSpeed(false));
}

TEST_F(OperatorCommands, TeleopPausesTheMissionAndOnlyThenObeysTheStick) {
  ASSERT_TRUE(person_->command(StartMission{}).has_value());
  ASSERT_TRUE(waitForWord(StatusWord::Auto));
  const std::uint64_t press = person_->session().press();
  person_->session().hold(JogBase{{0.3, 0, 0}}, press);
  const auto refused = person_->waitFor("the refused jog", seconds(3), [](const View& v) {
    return v.last_command && v.last_command->command == "jog_base" &&
           v.last_command->code == "wrong_mode";
  });
  EXPECT_TRUE(refused.has_value()) << refused.error();
  const auto mode = person_->command(SetMode{Mode::Teleop});
  ASSERT_TRUE(mode.has_value()) << mode.error();
  ASSERT_TRUE(waitForWord(StatusWord::Teleop));
  ASSERT_TRUE(waitForSpeed(false));
  const double from_x = person_->view().status->X_map_base.x_m;
  const auto driven =
      person_->holdWhile("jogging", seconds(10), [&](const View& v) -> std::optional<CommandBody> {
        if (v.status->X_map_base.x_m < from_x - 0.1) return std::nullopt;
        return JogBase{{-0.6, 0, 0}};
      });
  EXPECT_TRUE(driven.has_value()) << driven.error();
  EXPECT_TRUE(waitForSpeed(false));
}

TEST_F(OperatorCommands, AResetBringsTheRobotBackAndTheClockRunsOn) {
  ASSERT_TRUE(person_->command(StartMission{}).has_value());
  const auto away = person_->waitFor("a metre of way", seconds(20),
                                     [](const View& v) { return v.status->X_map_base.x_m > 1.0; });
  ASSERT_TRUE(away.has_value()) << away.error();
  const double elapsed_s = person_->view().status->mission_elapsed_s;
  ASSERT_TRUE(person_->command(ResetRobot{}).has_value());
  const auto back = person_->waitFor("the robot at its start", seconds(10), [](const View& v) {
    return v.status->resets == 1 && std::abs(v.status->X_map_base.x_m) < 0.6;
  });
  EXPECT_TRUE(back.has_value()) << back.error();
  EXPECT_GE(person_->view().status->mission_elapsed_s, elapsed_s);
}

/// The shipped robot without one line of its geometry, as a config of its own.
std::string configWithoutLidarMounting(const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  const auto geometry = resourcePath("robot_model/bob.yaml");
  const auto config = resourcePath("config/robot.yaml");
  if (!geometry || !config) return {};
  const auto copy = [](const std::string& from, const std::filesystem::path& to,
                       const std::string& leave_out, const std::string& add) {
    std::ifstream in(from);
    std::ofstream out(to);
    for (std::string line; std::getline(in, line);) {
      if (line.rfind(leave_out, 0) != 0) out << line << "\n";
    }
    out << add;
  };
  copy(*geometry, folder / "bob.yaml", "X_flange_lidar", "");
  copy(*config, folder / "robot.yaml",
       "geometry:", "geometry: " + (folder / "bob.yaml").string() + "\n");
  return (folder / "robot.yaml").string();
}

TEST(OperatorStart, AMissingTransformIsARowWithWhatToDoAndRefusesTheMissionByName) {
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / ("kiln-no-lidar-" + std::to_string(getpid()));
  const std::string config = configWithoutLidarMounting(folder);
  ASSERT_FALSE(config.empty());
  auto live = LiveSystem::start(3, {"--config", config}, {}, kiln::binaryDir() + "/bin");
  ASSERT_TRUE(live.has_value()) << live.error();
  auto person = (*live)->connectOperator("Ann");
  ASSERT_TRUE(person.has_value()) << person.error();
  const auto row = [](const View& v, const std::string& name) -> const Check* {
    if (!v.status) return nullptr;
    for (const Check& check : v.status->checks) {
      if (check.name == name) return &check;
    }
    return nullptr;
  };
  const auto told = (*person)->waitFor("the row", seconds(15), [&](const View& v) {
    const Check* lidar = row(v, "LiDAR");
    const Check* transforms = row(v, "Transforms");
    const Check* perception = row(v, "Perception");  // its first cloud takes a moment longer
    return lidar && lidar->ok && perception && perception->ok && transforms &&
           transforms->detail == "flange -> lidar is missing";
  });
  ASSERT_TRUE(told.has_value()) << told.error();
  const View view = (*person)->view();
  EXPECT_EQ(view.status->word, StatusWord::NotReady);
  EXPECT_FALSE(row(view, "Transforms")->ok);
  EXPECT_NE(row(view, "Transforms")->action, "");
  EXPECT_TRUE(row(view, "Pump current")->ok) << row(view, "Pump current")->detail;
  EXPECT_TRUE(row(view, "Controller limits")->ok) << row(view, "Controller limits")->detail;
  EXPECT_TRUE(row(view, "Clocks")->ok) << row(view, "Clocks")->detail;
  ASSERT_TRUE((*person)->command(AcquireLease{}).has_value());
  ASSERT_TRUE((*person)
                  ->waitFor("the lease", seconds(3), [](const View& v) { return v.lease.mine; })
                  .has_value());
  EXPECT_FALSE((*person)->command(StartMission{}).has_value());
  const auto refusal = (*person)->view().last_command;
  ASSERT_TRUE(refusal.has_value());
  EXPECT_EQ(refusal->code, "not_ready");
  EXPECT_NE(refusal->reason.find("Transforms: flange -> lidar is missing"), std::string::npos)
      << refusal->reason;
  person->reset();
  live->reset();
  std::filesystem::remove_all(folder);
}

TEST(Devices, AMissionWithoutItsDevicesIsNotReadyAndSaysWhy) {
  auto live = LiveSystem::start(3, {}, {"--without", "pumps"}, kiln::binaryDir() + "/bin");
  ASSERT_TRUE(live.has_value()) << live.error();
  auto person = (*live)->connectOperator("Ann");
  ASSERT_TRUE(person.has_value()) << person.error();
  const auto told = (*person)->waitFor("the reason", seconds(15), [](const View& v) {
    return v.status && v.status->word == StatusWord::NotReady &&
           v.status->reason.find("needs pumps, which this robot does not have") !=
               std::string::npos;
  });
  ASSERT_TRUE(told.has_value()) << told.error() << "; " << (*person)->view().status->reason;
  ASSERT_TRUE((*person)->command(AcquireLease{}).has_value());
  EXPECT_FALSE((*person)->command(StartMission{}).has_value());
  EXPECT_EQ((*person)->view().last_command->code, "not_ready");
  EXPECT_NE((*person)->view().last_command->reason.find("pumps"), std::string::npos);
}

}  // namespace
}  // namespace kiln
