// What each program says to bad input: one sentence with what, where and what to do, and a non-zero
// exit.
#include <fstream>
#include <sstream>

#include <gtest/gtest.h>
#include <sys/stat.h>

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

/// Two revolutions of a VLP-16 (manual, section 9.2: twelve blocks, strongest return) that sees
/// nothing.
std::string lidarPackets() {
  constexpr int kPackets = 160, kBlocks = 12, kStep_cdeg = 40, kPeriod_us = 1327;
  const auto put = [](std::string& to, std::size_t at, std::uint32_t value, std::size_t bytes) {
    for (std::size_t i = 0; i < bytes; ++i) to[at + i] = static_cast<char>(value >> (8 * i));
  };
  std::string all;
  for (int k = 0; k < kPackets; ++k) {
    std::string packet(1206, '\0');
    for (int block = 0; block < kBlocks; ++block) {
      const auto at = static_cast<std::size_t>(100 * block);
      put(packet, at, 0xEEFF, 2);
      put(packet, at + 2, static_cast<std::uint32_t>((k * kBlocks + block) * kStep_cdeg % 36000),
          2);
    }
    put(packet, 1200, static_cast<std::uint32_t>(k * kPeriod_us), 4);
    put(packet, 1204, 0x2237, 2);
    all += packet;
  }
  return all;
}

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

TEST_F(CommandLine, ANumberThatIsNoneIsBadInputEverywhere) {
  const std::vector<std::vector<std::string>> calls = {
      {"kiln-robotd", "--sim", "ipc:///none", "--until-s", "nan"},
      {"kiln-robotd", "--replay", "none.mcap", "--replay-speed", "nan"},
      {"kiln-robotd", "--no-such-option"},
      {"kiln-sim", "--seed", "-1"},
      {"kiln-sim", "--seed", "18446744073709551616"},
      {"kiln-sim", "--seed", ""},
      {"kiln-eval", "run", "--seed", "-1"},
      {"kiln-eval", "run", "--wall-limit-s", "nan"},
      {"kiln-eval", "no-such-evaluation"},
      {"kilnctl", "--timeout", "inf", "state"},
      {"kilnctl", "--timeout", "nan", "state"},
      {"kilnctl", "watch", "--seconds", "nan"},
      {"kilnctl", "hold", "pumps", "nan"},
      {"kilnctl", "jog", "base", "0", "inf", "0"},
      {"kilnctl", "macro", "run", ""}};
  for (const auto& call : calls) {
    const Outcome out = run(call);
    EXPECT_EQ(out.status, 2) << call.front() << " " << call.back() << ": " << out.text;
  }
}

/// Whatever is no regular file is refused at once, not waited for or filled into memory.
TEST_F(CommandLine, APipeADeviceAndAFolderAreNoFiles) {
  const std::string pipe = scratch_.file("pipe");
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  for (const std::string& path : {pipe, std::string("/dev/zero"), scratch_.path()}) {
    const std::string state = scratch_.file("state");
    for (const std::vector<std::string>& source :
         {std::vector<std::string>{"--replay", path},
          {"--lidar", path},
          {"--thermal", path == scratch_.path() ? "/dev/zero" : path},
          {"--config", path}}) {
      std::vector<std::string> argv{"kiln-robotd", "--state-dir", state, "--listen",
                                    "ipc://" + scratch_.file("link")};
      argv.insert(argv.end(), source.begin(), source.end());
      const Outcome out = run(argv);
      EXPECT_EQ(out.status, 2) << source.front() << " " << path << ": " << out.text;
    }
    const std::string capture = write("raw", lidarPackets());
    const Outcome map = run({"kiln-robotd", "--lidar", capture, "--set", "localization.map=" + path,
                             "--state-dir", state, "--listen", "ipc://" + scratch_.file("link")});
    EXPECT_EQ(map.status, 2) << path << ": " << map.text;
  }
}

TEST_F(CommandLine, AReportReplacesRegularFilesOnly) {
  const std::string capture = write("raw", lidarPackets());
  const std::string pipe = scratch_.file("pipe");
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  const Outcome out =
      run({"kiln-robotd", "--lidar", capture, "--until-s", "0.1", "--report", pipe, "--state-dir",
           scratch_.file("state"), "--listen", "ipc://" + scratch_.file("link")});
  EXPECT_EQ(out.status, 2);
  EXPECT_NE(out.text.find("not a regular file"), std::string::npos) << out.text;
  struct stat found = {};
  ASSERT_EQ(stat(pipe.c_str(), &found), 0);
  EXPECT_TRUE(S_ISFIFO(found.st_mode));
}

TEST_F(CommandLine, AnArenaThatStatesNoFenceIsRefusedByName) {
  const std::string capture = write("raw", lidarPackets());
  for (const char* text : {"{}\n", "name: kitchen\n", ""}) {
    const std::string arena = write("arena.yaml", text);
    const Outcome out =
        run({"kiln-robotd", "--lidar", capture, "--set", "arena=" + arena, "--until-s", "0.1",
             "--state-dir", scratch_.file("state"), "--listen", "ipc://" + scratch_.file("link")});
    EXPECT_EQ(out.status, 2) << text;
    EXPECT_NE(out.text.find(arena), std::string::npos) << out.text;
  }
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
