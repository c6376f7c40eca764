#include "common/record/run_replay.h"

#include <map>

#include <gtest/gtest.h>

#include "common/record/foxglove.h"
#include "common/record/run_topics.h"
#include "common/record/schema.h"
#include "common/wire/fire/codec/fire_codec.h"
#include "common/wire/fire/fire_view.h"
#include "common/wire/mission.h"
#include "common/wire/sensor.h"
#include "common/wire/telemetry.h"
#include "common/wire/world.h"
#include "tests/support/paths.h"
#include "tests/unit/common/record/sample_recording.h"

namespace kiln::test {
namespace {

/// The start of a JPEG of 64 x 48: all that anybody here looks at.
std::vector<std::uint8_t> tinyJpeg() {
  return {0xFF, 0xD8, 0xFF, 0xC0, 0, 17, 8, 0, 48, 0, 64, 3, 1, 0x22};
}

void put(RecordWriter& writer, std::string_view topic, std::string_view schema, double t,
         const std::string& payload) {
  static std::map<std::pair<std::string, std::string_view>, ChannelId> channels;
  const auto key = std::pair(writer.path(), topic);
  if (!channels.contains(key)) {
    const auto channel = writer.addChannel(std::string(topic), *protobufSchema(schema));
    ASSERT_TRUE(channel) << channel.error();
    channels[key] = *channel;
  }
  ASSERT_TRUE(writer.write(channels[key], at(t), at(t), payload));
}

TEST(RunReplay, GivesTheStationsMessagesBack) {
  const RecordFolder folder;
  {
    auto writer = RecordWriter::create(folder.file("run.mcap"));
    ASSERT_TRUE(writer) << writer.error();
    ASSERT_TRUE((*writer)->attach(std::string(run::kRunAttachment), "application/json",
                                  R"({"robot_name": "Bob", "mission_uuid": "abc"})", at(1)));
    RobotStatus status;
    status.seq = 17;
    status.stamp = at(2.0);
    put(**writer, "/kiln/robot_status", "kiln.v1.RobotStatus", 2.0, wire::encode(status));
    const JpegImage picture{at(2.5), 9, "operator_camera", 64, 48, tinyJpeg()};
    put(**writer, run::kOperatorCamera, "foxglove.CompressedImage", 2.5, foxglove::encode(picture));
    put(**writer, run::kPose, "foxglove.PoseInFrame", 3.0,
        foxglove::encodePose(at(3.0), "map", Eigen::Isometry3d::Identity()));
  }
  ManualClock wall;
  auto replay = RunReplay::open(folder.file("run.mcap"), wall);
  ASSERT_TRUE(replay) << replay.error();
  EXPECT_EQ(replay->info().robot_name, "Bob");
  EXPECT_EQ(replay->info().mission_uuid, "abc");
  replay->player().play();
  wall.advanceBy(std::chrono::seconds(10));
  std::map<Topic, std::string> got;
  ASSERT_TRUE(replay->poll(
      [&](Topic topic, std::string_view payload, Stamp) { got[topic] = std::string(payload); }));
  ASSERT_EQ(got.size(), 2u);  // the pose is for others
  EXPECT_EQ(wire::decodeRobotStatus(got[Topic::RobotStatus])->seq, 17u);
  const auto picture = wire::decodeJpeg(got[Topic::OperatorCamera]);
  ASSERT_TRUE(picture) << picture.error();
  EXPECT_EQ(picture->width, 64);
  EXPECT_EQ(picture->frame, "operator_camera");
  EXPECT_EQ(picture->jpeg, tinyJpeg());
}

/// A run of the fire mission as Kiln of protocol 2 has recorded it, seconds of its end.
TEST(RunReplay, AProtocol2RecordingIsHandedOverAsOfToday) {
  ManualClock wall;
  auto replay = RunReplay::open(sourceDir() + "/tests/unit/common/record/protocol2.mcap", wall);
  ASSERT_TRUE(replay) << replay.error();
  replay->player().play();
  wall.advanceBy(std::chrono::seconds(60));
  std::map<Topic, std::string> got;
  const auto keep = [&](Topic topic, std::string_view payload, Stamp) {
    got[topic] = std::string(payload);
  };
  for (int i = 0; i < 20; ++i) {
    const auto polled = replay->poll(keep);
    ASSERT_TRUE(polled) << polled.error();
  }
  const auto info = wire::decodeMissionInfo(got[Topic::MissionInfo]);
  ASSERT_TRUE(info) << info.error();
  EXPECT_EQ(info->mission, "fire");
  EXPECT_EQ(info->panels.size(), 4u);
  const auto status = wire::decodeRobotStatus(got[Topic::RobotStatus]);
  ASSERT_TRUE(status) << status.error();
  const WaterLevels water = fire::waterLevels(status->figures);
  EXPECT_GT(water.sprayed_l_est, 1.0);
  EXPECT_NEAR(findFigure(status->figures, "water.left")->value, 10.0 - water.sprayed_l_est, 1e-9);
  const auto scene = wire::decodeScene(got[Topic::Scene]);
  ASSERT_TRUE(scene) << scene.error();
  const auto site = wire::decodeFireSite(scene->detail.data);
  ASSERT_TRUE(site) << site.error();
  EXPECT_EQ(site->places.size(), 2u);
  EXPECT_EQ(site->fires.size(), 1u);
  EXPECT_EQ(scene->items.size(), fire::sceneItems(*site).size());
  const auto stream = wire::decodeMissionDetail(got[Topic::MissionStream]);
  ASSERT_TRUE(stream) << stream.error();
  EXPECT_TRUE(wire::decodeHeat(stream->data)) << stream->schema;
  const auto macros = wire::decodeMacros(got[Topic::Macros]);
  ASSERT_TRUE(macros) << macros.error();
  ASSERT_FALSE(macros->empty());
  bool uses = false;
  for (const MacroInfo& macro : *macros) uses = uses || macro.uses.starts_with("est. ");
  EXPECT_TRUE(uses) << "litres became text";
}

TEST(RunReplay, RefusesARecordingOfSomethingElse) {
  const RecordFolder folder;
  writeSample(folder.file("a.mcap"), 2.0);
  ManualClock wall;
  const auto replay = RunReplay::open(folder.file("a.mcap"), wall);
  ASSERT_FALSE(replay);
  EXPECT_EQ(replay.error().code, ErrorCode::InvalidInput);
}

}  // namespace
}  // namespace kiln::test
