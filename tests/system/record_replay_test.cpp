// A recording made by the daemon itself: switched by command, cut by kill -9, and run again.
#include <csignal>
#include <filesystem>

#include <gtest/gtest.h>

#include "common/record/record_reader.h"
#include "common/record/run_topics.h"
#include "common/wire/recording.h"
#include "common/wire/telemetry.h"
#include "robot/evaluation/live_system.h"
#include "tests/support/paths.h"

namespace kiln {
namespace {

namespace fs = std::filesystem;
using std::chrono::seconds;
using View = ScriptedOperator::View;

std::string onlyFileIn(const std::string& folder) {
  std::string path;
  for (const auto& entry : fs::directory_iterator(folder)) path = entry.path().string();
  return path;
}

/// The newest status in a recording.
RobotStatus lastStatus(const RecordReader& reader) {
  const auto newest = reader.newestBefore(reader.end(), {run::topicName(Topic::RobotStatus)});
  const auto status = newest.empty() ? Result<RobotStatus>(RobotStatus{})
                                     : wire::decodeRobotStatus(newest.front().data);
  return status.value_or(RobotStatus{});
}

std::uint64_t messagesOf(const RecordReader& reader, const std::string& name) {
  for (const RecordedTopic& topic : reader.topics()) {
    if (topic.topic == name) return topic.messages.value_or(0);
  }
  return 0;
}

TEST(RecordReplay, KilledDaemonLosesTwoSecondsAtMostAndItsRunCanBeRunAgain) {
  const ScratchFolder scratch("record");
  const std::string folder = scratch.file("runs");
  auto live = LiveSystem::start(3, {"--record", folder, "--start"}, {}, binaryDir() + "/bin");
  ASSERT_TRUE(live) << live.error();
  auto person = (*live)->connectOperator("Ann");
  ASSERT_TRUE(person) << person.error();
  const auto five_seconds = [](const View& v) {
    return v.status && v.status->recording.on && v.status->recording.duration_s > 5.0;
  };
  ASSERT_TRUE((*person)->waitFor("five seconds of recording", seconds(40), five_seconds));
  const Stamp heard = (*person)->view().status->stamp;
  (*live)->robot().signal(SIGKILL);
  ASSERT_TRUE((*live)->robot().wait(seconds(5)));

  const std::string path = onlyFileIn(folder);
  const auto reader = RecordReader::open(path);
  ASSERT_TRUE(reader) << reader.error();
  EXPECT_FALSE(reader->complete());
  EXPECT_LE(toSeconds(heard - reader->end()), 2.0);
  EXPECT_EQ(lastStatus(*reader).recording.dropped, 0u);
  const std::uint64_t scans = messagesOf(*reader, std::string(run::kLidarScan));
  EXPECT_GT(scans, 20u);

  // Once more, from the file: as many scans and thermal frames are looked at, and the robot is
  // found where it was.
  const std::string again = scratch.file("again");
  auto replay = ChildProcess::start(
      {binaryDir() + "/bin/kiln-robotd", "--replay", path, "--replay-speed", "0", "--record", again,
       "--state-dir", scratch.file("state"), "--listen", "ipc://" + scratch.file("link")},
      scratch.file("replay.log"));
  ASSERT_TRUE(replay) << replay.error();
  ASSERT_EQ(replay->wait(seconds(60)), 0) << tailOf(scratch.file("replay.log"), 6);
  const auto second = RecordReader::open(onlyFileIn(again));
  ASSERT_TRUE(second) << second.error();
  EXPECT_TRUE(second->complete());
  EXPECT_EQ(messagesOf(*second, std::string(run::kLidarScan)), scans);
  EXPECT_GE(messagesOf(*second, "/kiln/cloud") + 5, messagesOf(*reader, "/kiln/cloud"));
  EXPECT_GE(messagesOf(*second, "/kiln/heat") + 5, messagesOf(*reader, "/kiln/heat"));
  const RobotStatus before = lastStatus(*reader), after = lastStatus(*second);
  EXPECT_EQ(after.environment, Environment::Replay);
  // The robot was under way, at 1 m/s at most, and the last status of each is not of one instant.
  const double apart_s = std::abs(toSeconds(before.stamp - after.stamp));
  EXPECT_LT(apart_s, 2.0);
  EXPECT_NEAR(after.X_map_base.x_m, before.X_map_base.x_m, 0.1 + 1.0 * apart_s);
  EXPECT_NEAR(after.X_map_base.y_m, before.X_map_base.y_m, 0.1);
  EXPECT_NEAR(after.X_map_base.yaw_rad, before.X_map_base.yaw_rad, 0.05);
}

TEST(RecordReplay, IsSwitchedByCommandWithoutTheLease) {
  auto live = LiveSystem::start(3, {}, {}, binaryDir() + "/bin");
  ASSERT_TRUE(live) << live.error();
  auto person = (*live)->connectOperator("Ann");
  ASSERT_TRUE(person) << person.error();
  const auto recording = [&](bool on) {
    return (*person)->waitFor(
        on ? "a recording" : "no recording", seconds(10),
        [on](const View& v) { return v.status && v.status->recording.on == on; });
  };
  ASSERT_TRUE(recording(false));
  ASSERT_TRUE((*person)->command(SetRecording{true}));
  ASSERT_TRUE(recording(true));
  ASSERT_TRUE((*person)->command(SetRecording{false}));
  ASSERT_TRUE(recording(false));
  const auto reader =
      RecordReader::open(onlyFileIn((*live)->scratch().file("state") + "/recordings"));
  ASSERT_TRUE(reader) << reader.error();
  EXPECT_TRUE(reader->complete());
  // The command that began it came before the file; the one that ended it stands in it.
  EXPECT_EQ(messagesOf(*reader, std::string(run::kCommands)), 1u);
  EXPECT_EQ(messagesOf(*reader, "/kiln/fsm_info"), 1u);  // latched before the recording began
}

}  // namespace
}  // namespace kiln
