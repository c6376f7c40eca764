// A recording of every topic, opened and decoded by somebody else's reader: @mcap/core from the npm
// registry, which is fetched into the build folder.
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "common/record/record_reader.h"
#include "common/record/run_topics.h"
#include "common/wire/fire/codec/fire_codec.h"
#include "common/wire/fire/fire_view.h"
#include "common/wire/fsm.h"
#include "common/wire/localization.h"
#include "common/wire/mission.h"
#include "common/wire/sensor.h"
#include "common/wire/telemetry.h"
#include "common/wire/world.h"
#include "robot/app/run_recorder.h"
#include "tests/support/paths.h"

namespace kiln {
namespace {

namespace fs = std::filesystem;

fs::path toolFolder() { return fs::path(binaryDir()) / "tests" / "mcap_reader"; }

bool shell(const std::string& command) { return std::system(command.c_str()) == 0; }

std::string textOf(const fs::path& path) {
  std::ifstream in(path);
  std::ostringstream out;
  out << in.rdbuf();
  return out.str();
}

/// Why the reader cannot be had; empty = it is installed.
std::string installReader() {
  if (!shell("command -v node >/dev/null && command -v npm >/dev/null"))
    return "node and npm are not installed (Debian: apt install nodejs npm)";
  const fs::path tool = toolFolder();
  fs::create_directories(tool);
  const fs::path source = fs::path(sourceDir()) / "tests" / "support" / "mcap_reader";
  for (const char* file : {"package.json", "read.cjs"})
    fs::copy_file(source / file, tool / file, fs::copy_options::overwrite_existing);
  if (shell("cd '" + tool.string() + "' && npm ls >/dev/null 2>&1")) return {};
  if (!shell("cd '" + tool.string() +
             "' && npm install --no-audit --no-fund --silent >npm.log 2>&1"))
    return "the npm registry does not give @mcap/core: " + textOf(tool / "npm.log");
  return {};
}

PointCloud cloud() {
  PointCloud out;
  out.stamp = stampFromNanoseconds(1'500'000'000);
  out.frame = "lidar";
  for (int i = 0; i < 2000; ++i)
    out.push(0.01f * static_cast<float>(i), 1.0f, -0.5f, 20, static_cast<std::uint8_t>(i % 16),
             0.0f);
  return out;
}

template <class T>
void publish(RunRecorder& recorder, Topic topic, const T& value) {
  recorder.tap().published(
      topic, [&value] { return wire::encode(value); }, stampFromNanoseconds(2'000'000'000));
}

/// One message and more on every topic that there is.
std::string record(const std::string& folder) {
  ManualClock clock(stampFromNanoseconds(1'000'000'000));
  RunRecorder::Config config;
  config.min_free_gb = 0.0;
  RunRecorder::Run run{folder, "Bob", "0.1.0", "mission", "sim", "name: Bob\n", true};
  RobotStatus status;
  status.checks = {{"LiDAR", true, "10 Hz"}};
  FsmInfo info;
  info.mission = "fire";
  FsmStatus fsm;
  fsm.state = "AimHose";
  Scene scene;
  scene.planned.waypoints_map = {{1, 2, 0.5}};
  const std::vector<MacroInfo> macros{{"spray", "", 3, "", "est. 0.5 l"}};
  const LogBatch log{{{clock.now(), 2, "mission", "started"}, {clock.now(), 4, "arm", "stopped"}},
                     0};
  LocalizationStatus where;
  where.method = "surfel map";
  MapLayer layer;
  layer.points_map = {{1, 2, 3}};
  layer.submaps = {"indoor"};
  layer.submap_of = {0};
  Trajectory driven;
  driven.legs = {{0, {{1, 2, 0}, {2, 2, 0}}}};
  const PointCloud points = cloud();
  ThermalImage thermal;
  thermal.counts.assign(160 * 120, 29'500);
  HeatDetections heat;
  heat.blobs.resize(2);
  const MissionDetail stream = wire::encodeDetail(heat);
  const MissionInfo mission = fire::missionInfo(0.5, 30.0);
  const JpegImage head{clock.now(), 1,  "rgb",
                       64,          48, {0xFF, 0xD8, 0xFF, 0xC0, 0, 17, 8, 0, 48, 0, 64, 3, 1, 2}};
  JpegImage operator_camera = head;
  operator_camera.frame = "operator_camera";
  {
    RunRecorder recorder(config, run, clock);
    recorder.set(true);
    publish(recorder, Topic::RobotStatus, status);
    publish(recorder, Topic::FsmInfo, info);
    publish(recorder, Topic::FsmStatus, fsm);
    publish(recorder, Topic::Scene, scene);
    publish(recorder, Topic::Macros, macros);
    publish(recorder, Topic::Localization, where);
    publish(recorder, Topic::MapLayer, layer);
    publish(recorder, Topic::Trajectory, driven);
    publish(recorder, Topic::Log, log);
    recorder.tap().published(
        Topic::Cloud, [&points] { return wire::encode(points, 0.005); }, clock.now());
    publish(recorder, Topic::Thermal, thermal);
    publish(recorder, Topic::MissionStream, stream);
    publish(recorder, Topic::MissionInfo, mission);
    publish(recorder, Topic::HeadCamera, head);
    publish(recorder, Topic::OperatorCamera, operator_camera);
    recorder.tap().command({"client", "Ann", 1, 1, clock.now(), 0, StartMission{}}, clock.now());
    recorder.tap().ack({"client", 1, "start_mission", AckOutcome::Done, "", "", "", 0},
                       clock.now());
    for (int i = 0; i < 20; ++i) recorder.scan(std::make_shared<PointCloud>(points));
    DeviceSample sample;
    sample.stamp = clock.now();
    sample.arm.emplace();
    sample.base.emplace();
    sample.pumps.emplace();
    recorder.devices(sample);
    recorder.transforms({{clock.now(), "map", "odom", Eigen::Isometry3d::Identity()}},
                        Eigen::Isometry3d::Identity(), clock.now());
  }
  return fs::directory_iterator(folder)->path().string();
}

class McapReader : public testing::Test {
 protected:
  void SetUp() override {
    if (const std::string missing = installReader(); !missing.empty()) GTEST_SKIP() << missing;
    std::string name = (fs::temp_directory_path() / "kiln-mcap-XXXXXX").string();
    ASSERT_NE(::mkdtemp(name.data()), nullptr);
    folder_ = name;
  }
  void TearDown() override {
    std::error_code ignored;
    if (!folder_.empty()) fs::remove_all(folder_, ignored);
  }
  nlohmann::json read(const std::string& path) const {
    const std::string out = (folder_ / "read.json").string();
    EXPECT_TRUE(shell("node '" + (toolFolder() / "read.cjs").string() + "' '" + path + "' > '" +
                      out + "'"));
    return nlohmann::json::parse(textOf(out), nullptr, false);
  }
  fs::path folder_;
};

TEST_F(McapReader, DecodesEveryChannelOfARecording) {
  const std::string path = record((folder_ / "recordings").string());
  const auto found = read(path);
  ASSERT_TRUE(found.is_object());
  const auto ours = RecordReader::open(path);
  ASSERT_TRUE(ours) << ours.error();
  std::uint64_t total = 0;
  for (const RecordedTopic& topic : ours->topics()) {
    ASSERT_TRUE(found["topics"].contains(topic.topic)) << topic.topic;
    EXPECT_EQ(found["topics"][topic.topic]["messages"], topic.messages.value_or(0)) << topic.topic;
    EXPECT_EQ(found["topics"][topic.topic]["schema"], topic.schema);
    total += topic.messages.value_or(0);
  }
  for (const TopicInfo& info : topicTable())
    EXPECT_TRUE(found["topics"].contains(run::topicName(info.topic))) << info.name;
  EXPECT_EQ(found["indexed"], total);
  EXPECT_EQ(found["streamed"], total);  // once more from the front, all CRCs checked
  EXPECT_TRUE(found["ended"]);
  EXPECT_TRUE(found["ordered"]);
  EXPECT_EQ(found["attachments"]["robot.yaml"], 10);
  const auto fields = found["topics"]["/lidar/scan"]["fields"].get<std::vector<std::string>>();
  for (const char* field : {"timestamp", "frame_id", "point_stride", "fields", "data"})
    EXPECT_NE(std::find(fields.begin(), fields.end(), field), fields.end()) << field;
}

/// KILN_RECORDING=FILE: the same for a recording of your own, e.g. of the demo.
TEST_F(McapReader, DecodesTheRecordingNamedInTheEnvironment) {
  const char* path = std::getenv("KILN_RECORDING");
  if (path == nullptr) GTEST_SKIP() << "set KILN_RECORDING to a .mcap file to have it checked";
  const auto found = read(path);
  ASSERT_TRUE(found.is_object());
  EXPECT_TRUE(found["ended"]);
  EXPECT_EQ(found["indexed"], found["streamed"]);
  EXPECT_TRUE(found["topics"].contains("/lidar/scan"));
  EXPECT_TRUE(found["topics"].contains("/kiln/robot_status"));
}

}  // namespace
}  // namespace kiln
