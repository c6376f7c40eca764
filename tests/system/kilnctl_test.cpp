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

/// What one stream of a process has written so far.
class Caught {
 public:
  Caught() {
    int ends[2];
    KILN_CHECK(::pipe2(ends, O_CLOEXEC | O_NONBLOCK) == 0);
    out_ = ends[0];
    in_ = ends[1];
  }
  ~Caught() {
    ::close(out_);
    closeWriter();
  }
  [[nodiscard]] int writer() const { return in_; }
  void closeWriter() { ::close(std::exchange(in_, -1)); }
  void take() {
    char buffer[4096];
    for (ssize_t n = 0; (n = ::read(out_, buffer, sizeof buffer)) > 0;)
      text_.append(buffer, static_cast<size_t>(n));
  }
  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  int out_ = -1, in_ = -1;
  std::string text_;
};

/// kilnctl as a process of its own, its output caught.
class Kilnctl {
 public:
  enum class Print { Json, Text };
  Kilnctl(const std::string& endpoint, std::vector<std::string> args,
          const std::string& name = "ctl", Print print = Print::Json) {
    args.insert(args.begin(),
                {kiln::binaryDir() + "/bin/kilnctl", "--connect", endpoint, "--name", name});
    if (print == Print::Json) args.insert(args.begin() + 1, "--json");
    std::vector<char*> argv;
    for (std::string& arg : args) argv.push_back(arg.data());
    argv.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, out_.writer(), STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&actions, errors_.writer(), STDERR_FILENO);
    KILN_CHECK(::posix_spawn(&pid_, argv[0], &actions, nullptr, argv.data(), environ) == 0,
               argv[0]);
    posix_spawn_file_actions_destroy(&actions);
    out_.closeWriter();
    errors_.closeWriter();
  }
  ~Kilnctl() {
    if (!exit_) {
      ::kill(pid_, SIGKILL);
      ::waitpid(pid_, nullptr, 0);
    }
  }
  void signal(int number) const { ::kill(pid_, number); }
  /// Also takes in what was printed so far.
  [[nodiscard]] bool ended() {
    out_.take();
    errors_.take();
    int status = 0;
    if (!exit_ && ::waitpid(pid_, &status, WNOHANG) == pid_) {
      exit_ = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
      return ended();  // the rest of its output
    }
    return exit_.has_value();
  }
  [[nodiscard]] int exitCode() const { return exit_.value_or(-1); }
  [[nodiscard]] const std::string& text() const { return out_.text(); }
  [[nodiscard]] const std::string& errors() const { return errors_.text(); }

 private:
  pid_t pid_ = 0;
  Caught out_, errors_;
  std::optional<int> exit_;
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

TEST(KilnctlProgram, AnAddressThatIsNoneIsWrongUsage) {
  const TempFolder elsewhere;
  LinkedRobot robot(elsewhere.endpoint());
  Kilnctl ctl("foo", {"state"});
  ASSERT_TRUE(tickUntil(robot, [&] { return ctl.ended(); }));
  EXPECT_EQ(ctl.exitCode(), 2);
  EXPECT_THAT(ctl.errors(), HasSubstr("'foo' is no tcp://HOST:PORT"));
}

TEST(KilnctlProgram, AnUnknownCommandNamesTheNearest) {
  const TempFolder folder;
  LinkedRobot robot(folder.endpoint());
  Kilnctl near(folder.endpoint(), {"stat"});
  Kilnctl far(folder.endpoint(), {"frobnicate"});
  ASSERT_TRUE(tickUntil(robot, [&] { return near.ended() && far.ended(); }));
  EXPECT_THAT(near.errors(), HasSubstr("no command 'stat'; did you mean 'state'?"));
  EXPECT_THAT(far.errors(), HasSubstr("no command 'frobnicate'"));
}

TEST(KilnctlProgram, ARefusalInWordsGoesToStandardErrorAndSaysHowToGetControl) {
  const TempFolder folder;
  LinkedRobot robot(folder.endpoint());
  LinkedOperator anna(operatorConfig(folder.endpoint(), "anna"));
  ASSERT_TRUE(takeControl(robot, anna));
  Kilnctl ctl(folder.endpoint(), {"mode", "teleop"}, "ctl", Kilnctl::Print::Text);
  ASSERT_TRUE(tickUntil(robot, [&] { return ctl.ended(); }));
  EXPECT_EQ(ctl.exitCode(), 1);
  EXPECT_EQ(ctl.text(), "");
  EXPECT_THAT(ctl.errors(), HasSubstr("anna has control"));
  EXPECT_THAT(ctl.errors(), HasSubstr("--take-over"));
}

TEST(KilnctlProgram, SaysThatThereAreNoAlarms) {
  const TempFolder folder;
  LinkedRobot robot(folder.endpoint());
  Kilnctl ctl(folder.endpoint(), {"alarms"}, "ctl", Kilnctl::Print::Text);
  ASSERT_TRUE(tickUntil(robot, [&] { return ctl.ended(); }));
  EXPECT_EQ(ctl.exitCode(), 0);
  EXPECT_EQ(ctl.text(), "no alarms\n");
}

TEST(KilnctlProgram, WithoutANameItSaysWhoItIsAllTheSame) {
  const TempFolder folder;
  LinkedRobot robot(folder.endpoint());
  Kilnctl ctl(folder.endpoint(), {"lease", "acquire"}, "");
  const auto holder = [&] { return robot.authority.lease(robot.clock.now()).holder_name; };
  ASSERT_TRUE(tickUntil(robot, [&] { return !holder().empty(); }));
  EXPECT_THAT(holder(), HasSubstr("kilnctl"));
}

TEST(KilnctlProgram, NobodyStaysBehindWhenItHasEnded) {
  const TempFolder folder;
  LinkedRobot robot(folder.endpoint());
  for (const std::vector<std::string>& args :
       std::vector<std::vector<std::string>>{{"state"}, {"speed", "0.3"}}) {
    Kilnctl ctl(folder.endpoint(), args);
    ASSERT_TRUE(tickUntil(robot, [&] { return ctl.ended(); }));
    EXPECT_TRUE(tickUntil(
        robot, [&] { return robot.link->operators().empty(); }, 2.0))
        << args.front();
  }
}

TEST(KilnctlProgram, HelpNamesItsArgumentsAndGivesExamples) {
  const TempFolder folder;
  LinkedRobot robot(folder.endpoint());
  Kilnctl pose(folder.endpoint(), {"pose", "--help"});
  Kilnctl all(folder.endpoint(), {"--help"});
  ASSERT_TRUE(tickUntil(robot, [&] { return pose.ended() && all.ended(); }));
  EXPECT_THAT(pose.text(), HasSubstr("X Y YAW_DEG"));
  EXPECT_THAT(all.text(), HasSubstr("kilnctl jog base 0.2 0 0 --seconds 2"));
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
