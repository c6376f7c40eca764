// What each program says to bad input: one sentence with what, where and what to do, and a non-zero
// exit.
#include <fstream>
#include <sstream>

#include <gtest/gtest.h>

#include "robot/evaluation/child_process.h"
#include "tests/support/paths.h"

namespace kiln {
namespace {

using std::chrono::seconds;

std::string program(const std::string& name) { return kiln::binaryDir() + "/bin/" + name; }

struct Outcome {
  int status = -1;
  std::string text;
};

class CommandLine : public testing::Test {
 protected:
  Outcome run(std::vector<std::string> argv) {
    argv.front() = program(argv.front());
    const std::string log = scratch_.file("out.log");
    auto child = ChildProcess::start(argv, log);
    if (!child) return {-1, child.error().message};
    const auto status = child->wait(seconds(15));
    std::ifstream in(log);
    std::ostringstream text;
    text << in.rdbuf();
    return {status.value_or(-1), text.str()};
  }
  std::string write(const std::string& name, const std::string& text) {
    std::ofstream(scratch_.file(name)) << text;
    return scratch_.file(name);
  }
  ScratchFolder scratch_{"cli"};
};

TEST_F(CommandLine, EveryProgramHasHelpAndVersion) {
  for (const char* name : {"kiln-sim", "kiln-robotd", "kiln-eval", "kilnctl", "kiln-station"}) {
    EXPECT_EQ(run({name, "--help"}).status, 0) << name;
    const Outcome version = run({name, "--version"});
    EXPECT_EQ(version.status, 0) << name;
    EXPECT_NE(version.text.find(name), std::string::npos) << version.text;
  }
}

TEST_F(CommandLine, RobotdNamesAnUnknownKeyWithFileAndLine) {
  const std::string config = write("robot.yaml", "name: Bob\nteleop:\n  max_speed: 1\n");
  const Outcome out = run({"kiln-robotd", "--config", config, "--print-config"});
  EXPECT_EQ(out.status, 2);
  EXPECT_NE(out.text.find("robot.yaml:3: unknown key 'max_speed'; did you mean 'max_speed_mps'?"),
            std::string::npos)
      << out.text;
}

TEST_F(CommandLine, RobotdNeedsSomethingToRunOn) {
  const Outcome out = run({"kiln-robotd", "--state-dir", scratch_.file("state")});
  EXPECT_EQ(out.status, 2);
  EXPECT_NE(out.text.find("--sim"), std::string::npos) << out.text;
}

TEST_F(CommandLine, RobotdRefusesAnAddressThatOthersCanReach) {
  const std::string capture = write("none.pcap", "");
  const Outcome out = run({"kiln-robotd", "--lidar", capture, "--listen", "tcp://0.0.0.0:7300",
                           "--state-dir", scratch_.file("state")});
  EXPECT_EQ(out.status, 2) << out.text;
}

TEST_F(CommandLine, SimNamesAMissingWorld) {
  const Outcome out = run({"kiln-sim", "--world", scratch_.file("nowhere.yaml"), "--listen",
                           "ipc://" + scratch_.file("w")});
  EXPECT_NE(out.status, 0);
  EXPECT_NE(out.text.find("nowhere.yaml"), std::string::npos) << out.text;
}

TEST_F(CommandLine, ASecondDaemonOnOneStateFolderIsRefused) {
  const std::string endpoint = "ipc://" + scratch_.file("world");
  auto world =
      ChildProcess::start({program("kiln-sim"), "--listen", endpoint}, scratch_.file("sim.log"));
  ASSERT_TRUE(world.has_value());
  auto first =
      ChildProcess::start({program("kiln-robotd"), "--sim", endpoint, "--state-dir",
                           scratch_.file("state"), "--listen", "ipc://" + scratch_.file("link1")},
                          scratch_.file("first.log"));
  ASSERT_TRUE(first.has_value());
  while (!std::ifstream(scratch_.file("state") + "/kiln-robotd.lock").good()) {
    ASSERT_FALSE(first->wait(std::chrono::milliseconds(10)).has_value())
        << tailOf(scratch_.file("first.log"), 5);
  }
  const Outcome out = run({"kiln-robotd", "--sim", endpoint, "--state-dir", scratch_.file("state"),
                           "--listen", "ipc://" + scratch_.file("link2")});
  EXPECT_EQ(out.status, 2);
  EXPECT_NE(out.text.find("another kiln-robotd"), std::string::npos) << out.text;
}

TEST_F(CommandLine, EvalListsItsEvaluations) {
  const Outcome out = run({"kiln-eval", "list"});
  EXPECT_EQ(out.status, 0);
  for (const char* name : {"fire", "fallback", "stop", "spray-calibration"}) {
    EXPECT_NE(out.text.find(name), std::string::npos) << name;
  }
  EXPECT_EQ(run({"kiln-eval", "fire", "--seeds", "5-1"}).status, 2);
}

}  // namespace
}  // namespace kiln
