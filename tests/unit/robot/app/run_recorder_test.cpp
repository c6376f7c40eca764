#include "robot/app/run_recorder.h"

#include <filesystem>
#include <fstream>
#include <future>
#include <map>
#include <thread>

#include <gtest/gtest.h>

#include "common/record/record_reader.h"
#include "common/record/run_topics.h"
#include "common/wire/recording.h"
#include "common/wire/telemetry.h"

namespace kiln {
namespace {

class RunRecorderTest : public testing::Test {
 protected:
  void SetUp() override {
    std::string name = (std::filesystem::temp_directory_path() / "kiln-recorder-XXXXXX").string();
    ASSERT_NE(::mkdtemp(name.data()), nullptr);
    folder_ = name;
    clock_.advanceTo(stampFromNanoseconds(5'000'000'000));
  }
  void TearDown() override {
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
  }
  std::unique_ptr<RunRecorder> recorder(RunRecorder::Config config = {}) {
    RunRecorder::Run run;
    run.folder = folder_ + "/recordings";
    run.robot_name = "Bob";
    run.version = "1.2.3";
    run.mission_uuid = "0123456789abcdef";
    run.environment = "sim";
    run.config_yaml = "name: Bob\n";
    return std::make_unique<RunRecorder>(config, run, clock_);
  }
  /// The one file in the folder.
  Result<RecordReader> open() const {
    std::string path;
    for (const auto& entry : std::filesystem::directory_iterator(folder_ + "/recordings"))
      path = entry.path().string();
    return RecordReader::open(path);
  }
  static void publish(RunRecorder& recorder, Topic topic, const std::string& payload) {
    recorder.tap().published(
        topic, [payload] { return payload; }, stampFromNanoseconds(6'000'000'000));
  }
  bool waitFor(const std::function<bool()>& condition) const {
    const SteadyClock wall;
    const Stamp limit = wall.now() + std::chrono::seconds(20);
    while (!condition() && wall.now() < limit) std::this_thread::yield();
    return condition();
  }
  std::string folder_;
  ManualClock clock_;
};

RunRecorder::Config roomy() {
  RunRecorder::Config config;
  config.min_free_gb = 0.0;
  return config;
}

PointCloudPtr scan() {
  auto cloud = std::make_shared<PointCloud>();
  cloud->frame = "lidar";
  cloud->push(1, 2, 3, 4, 5, 0.01f);
  return cloud;
}

TEST_F(RunRecorderTest, WritesWhatItIsGivenAndWhatTheRunWas) {
  auto recording = recorder(roomy());
  recording->set(true);
  RobotStatus status;
  status.seq = 7;
  publish(*recording, Topic::RobotStatus, wire::encode(status));
  publish(*recording, Topic::Log, wire::encode(LogBatch{{{Stamp{}, 3, "base", "80 °C"}}, 0}));
  recording->scan(scan());
  DeviceSample sample;
  sample.stamp = clock_.now();
  sample.arm.emplace().q[0] = 0.5;
  recording->devices(sample);
  recording->transforms({{sample.stamp, "map", "odom", Eigen::Isometry3d::Identity()}},
                        Eigen::Isometry3d::Identity(), sample.stamp);
  recording.reset();

  const auto reader = open();
  ASSERT_TRUE(reader) << reader.error();
  EXPECT_TRUE(reader->complete());
  std::map<std::string, std::string> schemas;
  for (const RecordedTopic& topic : reader->topics()) schemas[topic.topic] = topic.schema;
  EXPECT_EQ(schemas["/kiln/robot_status"], "kiln.v1.RobotStatus");
  EXPECT_EQ(schemas["/kiln/log"], "kiln.v1.LogBatch");
  EXPECT_EQ(schemas["/log"], "foxglove.Log");
  EXPECT_EQ(schemas["/lidar/scan"], "foxglove.PointCloud");
  EXPECT_EQ(schemas["/tf"], "foxglove.FrameTransforms");
  EXPECT_EQ(schemas["/pose"], "foxglove.PoseInFrame");
  const auto device = reader->messages({"/kiln/devices"}).next();
  ASSERT_TRUE(device && *device);
  EXPECT_EQ(wire::decodeDeviceSample((*device)->data)->arm->q[0], 0.5);
  EXPECT_EQ(reader->attachment("robot.yaml"), "name: Bob\n");
  EXPECT_NE(reader->attachment("run.json")->find("0123456789abcdef"), std::string::npos);
}

TEST_F(RunRecorderTest, BeginsWithWhatIsLatched) {
  auto recording = recorder(roomy());
  publish(*recording, Topic::Macros, "");  // published long before the recording begins
  publish(*recording, Topic::Cloud, "");   // not latched
  recording->set(true);
  recording->scan(scan());
  recording.reset();
  const auto reader = open();
  ASSERT_TRUE(reader) << reader.error();
  ASSERT_EQ(reader->topics().size(), 2u);
  EXPECT_EQ(reader->topics()[0].topic, "/kiln/macros");
}

TEST_F(RunRecorderTest, FullQueueDropsCountsAndNeverWaits) {
  RunRecorder::Config config = roomy();
  config.queue = 64;
  auto recording = recorder(config);
  recording->set(true);
  std::promise<void> entered, leave;
  recording->tap().published(
      Topic::Cloud,
      [&entered, &leave] {
        entered.set_value();
        leave.get_future().wait();
        return std::string();
      },
      clock_.now());
  entered.get_future().wait();  // the recorder hangs, as on a disk that does not answer
  for (int i = 0; i < 100; ++i) recording->scan(scan());
  EXPECT_EQ(recording->status().dropped, 36u);
  leave.set_value();
  recording.reset();
  const auto reader = open();
  ASSERT_TRUE(reader) << reader.error();
  int scans = 0;
  for (auto cursor = reader->messages({"/lidar/scan"}); *cursor.next();) ++scans;
  EXPECT_EQ(scans, 64);
}

TEST_F(RunRecorderTest, NearlyFullDiskEndsTheRecordingAndSaysSo) {
  RunRecorder::Config config;
  config.min_free_gb = 1e9;  // more than any disk has
  auto recording = recorder(config);
  recording->set(true);
  ASSERT_TRUE(waitFor([&] { return !recording->status().problem.empty(); }));
  EXPECT_FALSE(recording->status().on);
  EXPECT_FALSE(recording->on());
  EXPECT_NE(recording->status().problem.find("less than the limit"), std::string::npos);
  recording->scan(scan());  // the robot goes on
}

TEST_F(RunRecorderTest, CanBeSwitchedOffAndOnAgain) {
  auto recording = recorder(roomy());
  recording->set(true);
  recording->scan(scan());
  ASSERT_TRUE(waitFor([&] { return recording->status().on; }));
  const std::string first = recording->status().file;
  recording->set(false);
  ASSERT_TRUE(waitFor([&] { return !recording->status().on; }));
  recording->scan(scan());  // nobody wants it
  recording->set(true);
  ASSERT_TRUE(waitFor([&] { return recording->status().on; }));
  EXPECT_NE(recording->status().file, first);
  const auto reader = RecordReader::open(folder_ + "/recordings/" + first);
  ASSERT_TRUE(reader) << reader.error();
  EXPECT_TRUE(reader->complete());
  EXPECT_EQ(reader->topics().at(0).messages, 1u);
}

TEST_F(RunRecorderTest, FolderThatCannotBeMadeIsAProblemNotAnEnd) {
  std::ofstream(folder_ + "/recordings") << "a file stands where the folder should";
  auto recording = recorder(roomy());
  recording->set(true);
  ASSERT_TRUE(waitFor([&] { return !recording->status().problem.empty(); }));
  EXPECT_FALSE(recording->on());
}

}  // namespace
}  // namespace kiln
