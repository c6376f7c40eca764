#include <algorithm>
#include <csignal>

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include "common/core/check.h"
#include "tests/support/paths.h"
#include "tests/system/two_ends.h"

extern char** environ;

namespace kiln::test {
namespace {

using ::testing::HasSubstr;

/// kilnctl as a process of its own, its output caught.
class Kilnctl {
 public:
  Kilnctl(const std::string& endpoint, std::vector<std::string> args,
          const std::string& name = "ctl") {
    args.insert(args.begin(), {kiln::binaryDir() + "/bin/kilnctl", "--json", "--connect", endpoint,
                               "--name", name});
    std::vector<char*> argv;
    for (std::string& arg : args) argv.push_back(arg.data());
    argv.push_back(nullptr);
    int ends[2];
    KILN_CHECK(::pipe2(ends, O_CLOEXEC | O_NONBLOCK) == 0);
    out_ = ends[0];
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, ends[1], STDOUT_FILENO);
    KILN_CHECK(::posix_spawn(&pid_, argv[0], &actions, nullptr, argv.data(), environ) == 0,
               argv[0]);
    posix_spawn_file_actions_destroy(&actions);
    ::close(ends[1]);
  }
  ~Kilnctl() {
    if (!exit_) {
      ::kill(pid_, SIGKILL);
      ::waitpid(pid_, nullptr, 0);
    }
    ::close(out_);
  }
  void signal(int number) const { ::kill(pid_, number); }
  /// Also takes in what was printed so far.
  [[nodiscard]] bool ended() {
    char buffer[4096];
    for (ssize_t n = 0; (n = ::read(out_, buffer, sizeof buffer)) > 0;)
      text_.append(buffer, static_cast<size_t>(n));
    int status = 0;
    if (!exit_ && ::waitpid(pid_, &status, WNOHANG) == pid_) {
      exit_ = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
      return ended();  // the rest of its output
    }
    return exit_.has_value();
  }
  [[nodiscard]] int exitCode() const { return exit_.value_or(-1); }
  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  pid_t pid_ = 0;
  int out_ = -1;
  std::optional<int> exit_;
  std::string text_;
};

template <class Body>
std::ptrdiff_t countOf(const LinkedRobot& robot) {
  return std::count_if(robot.accepted.begin(), robot.accepted.end(),
                       [](const auto& a) { return std::holds_alternative<Body>(a.command.body); });
}

TEST(KilnctlProgram, PrintsTheStateAsOneJsonLine) {
  const TempFolder folder;
  LinkedRobot robot(folder.endpoint());
  Kilnctl ctl(folder.endpoint(), {"state"});
  ASSERT_TRUE(tickUntil(robot, [&] { return ctl.ended(); }));
  EXPECT_EQ(ctl.exitCode(), 0);
  EXPECT_EQ(std::count(ctl.text().begin(), ctl.text().end(), '\n'), 1);
  EXPECT_THAT(ctl.text(), HasSubstr("\"word\":\"NOT READY\""));
}

TEST(KilnctlProgram, JogsForItsTimeThenSendsZerosAndGivesControlBack) {
  const TempFolder folder;
  LinkedRobot robot(folder.endpoint());
  Kilnctl ctl(folder.endpoint(), {"jog", "base", "-0.2", "0", "0", "--seconds", "0.5"});
  ASSERT_TRUE(tickUntil(robot, [&] { return ctl.ended(); }));
  EXPECT_EQ(ctl.exitCode(), 0) << ctl.text();
  EXPECT_GT(countOf<JogBase>(robot), 5);
  EXPECT_EQ(countOf<ReleaseAll>(robot), 3);
  EXPECT_TRUE(robot.authority.lease(robot.clock.now()).holder_client.empty());
}

TEST(KilnctlProgram, JogsAtTheSpeedThatItIsTold) {
  const TempFolder folder;
  LinkedRobot robot(folder.endpoint());  // at a speed scale of 0.35
  Kilnctl ctl(folder.endpoint(), {"jog", "base", "0.2", "0", "0", "--seconds", "0.2"});
  ASSERT_TRUE(tickUntil(robot, [&] { return ctl.ended(); }));
  double asked_mps = 0.0;
  for (const auto& a : robot.accepted)
    if (const auto* jog = std::get_if<JogBase>(&a.command.body)) asked_mps = jog->twist.vx_mps;
  EXPECT_NEAR(asked_mps * 0.35, 0.2, 1e-6);
  Kilnctl fast(folder.endpoint(), {"jog", "base", "0.6", "0", "0", "--seconds", "0.2"});
  ASSERT_TRUE(tickUntil(robot, [&] { return fast.ended(); }));
  EXPECT_EQ(fast.exitCode(), 1);
  EXPECT_THAT(fast.text(), HasSubstr("needs a speed scale of 0.60"));
}

TEST(KilnctlProgram, WrongUsageIsStatusTwo) {
  const TempFolder folder;
  LinkedRobot robot(folder.endpoint());
  for (const std::vector<std::string>& args : std::vector<std::vector<std::string>>{
           {"stat"}, {"lease", "aquire"}, {"state", "--timeout", "-1"}}) {
    Kilnctl ctl(folder.endpoint(), args);
    ASSERT_TRUE(tickUntil(robot, [&] { return ctl.ended(); }));
    EXPECT_EQ(ctl.exitCode(), 2) << args.front();
  }
}

TEST(KilnctlProgram, OptionsMayStandBehindTheCommand) {
  const TempFolder folder;
  LinkedRobot robot(folder.endpoint());
  Kilnctl ctl(folder.endpoint(), {"state", "--json", "--timeout", "5"});
  ASSERT_TRUE(tickUntil(robot, [&] { return ctl.ended(); }));
  EXPECT_EQ(ctl.exitCode(), 0);
}

TEST(KilnctlProgram, EverySignalIsARelease) {
  for (const int number : {SIGINT, SIGTERM, SIGHUP}) {
    const TempFolder folder;
    LinkedRobot robot(folder.endpoint());
    Kilnctl ctl(folder.endpoint(), {"hold", "pumps", "1"});
    ASSERT_TRUE(tickUntil(robot, [&] { return countOf<HoldActuator>(robot) >= 3; })) << number;
    ctl.signal(number);
    ASSERT_TRUE(tickUntil(robot, [&] { return ctl.ended(); })) << number;
    EXPECT_EQ(ctl.exitCode(), 0) << number;
    EXPECT_EQ(countOf<ReleaseAll>(robot), 3) << number;
    EXPECT_THAT(robot.released, ::testing::ElementsAre(HoldKind::Actuator)) << number;
  }
}

TEST(KilnctlProgram, KilledItIsADeadMan) {
  const TempFolder folder;
  LinkedRobot robot(folder.endpoint());
  Kilnctl ctl(folder.endpoint(), {"jog", "base", "0.2", "0", "0"});
  ASSERT_TRUE(tickUntil(robot, [&] { return countOf<JogBase>(robot) >= 3; }));
  ctl.signal(SIGKILL);
  ASSERT_TRUE(tickUntil(robot, [&] { return !robot.released.empty(); }));
  EXPECT_EQ(countOf<ReleaseAll>(robot), 0);
  ASSERT_TRUE(tickUntil(
      robot, [&] { return robot.authority.lease(robot.clock.now()).holder_client.empty(); }));
}

TEST(KilnctlProgram, ItsStopCountsWhateverItIsCalled) {
  for (const std::string& name :
       {std::string(70'000, 'x'), std::string("\x1b[2J\n"), std::string()}) {
    const TempFolder folder;
    LinkedRobot robot(folder.endpoint());
    Kilnctl ctl(folder.endpoint(), {"stop"}, name);
    ASSERT_TRUE(tickUntil(robot, [&] { return ctl.ended(); }));
    EXPECT_EQ(ctl.exitCode(), 0) << ctl.text();
    EXPECT_TRUE(robot.stop.latched());
    EXPECT_LE(robot.stop.source().size(), 70u);
  }
}

TEST(KilnctlProgram, StopNeedsNoControl) {
  const TempFolder folder;
  LinkedRobot robot(folder.endpoint());
  LinkedOperator anna(operatorConfig(folder.endpoint(), "anna"));
  ASSERT_TRUE(takeControl(robot, anna));
  Kilnctl ctl(folder.endpoint(), {"stop"});
  ASSERT_TRUE(tickUntil(robot, [&] { return ctl.ended(); }));
  EXPECT_EQ(ctl.exitCode(), 0) << ctl.text();
  EXPECT_TRUE(robot.stop.latched());
}

TEST(KilnctlProgram, RefusalsNameTheHolderAndAreNoSuccess) {
  const TempFolder folder;
  LinkedRobot robot(folder.endpoint());
  LinkedOperator anna(operatorConfig(folder.endpoint(), "anna"));
  ASSERT_TRUE(takeControl(robot, anna));
  Kilnctl ctl(folder.endpoint(), {"mode", "autonomous"});
  ASSERT_TRUE(tickUntil(robot, [&] { return ctl.ended(); }));
  EXPECT_EQ(ctl.exitCode(), 1);
  EXPECT_THAT(ctl.text(), HasSubstr("\"holder\":\"anna\""));
}

TEST(KilnctlProgram, WithoutARobotItSaysSo) {
  const TempFolder folder;
  const TempFolder elsewhere;
  LinkedRobot robot(elsewhere.endpoint());  // gives the clock of tickUntil
  Kilnctl ctl(folder.endpoint(), {"--timeout", "0.5", "state"});
  ASSERT_TRUE(tickUntil(robot, [&] { return ctl.ended(); }));
  EXPECT_EQ(ctl.exitCode(), 3);
  EXPECT_THAT(ctl.text(), HasSubstr("no robot has answered"));
}

}  // namespace
}  // namespace kiln::test
