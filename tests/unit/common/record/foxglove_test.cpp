#include "common/record/foxglove.h"

#include <cmath>

#include <google/protobuf/descriptor.h>
#include <google/protobuf/descriptor.pb.h>
#include <gtest/gtest.h>

#include "common/record/run_topics.h"
#include "common/record/schema.h"
#include "common/wire/jpeg_size.h"
#include "common/wire/recording.h"

namespace kiln {
namespace {

namespace pb = google::protobuf;

PointCloud sampleCloud() {
  PointCloud cloud;
  cloud.stamp = stampFromNanoseconds(12'345'678'901);
  cloud.frame = "lidar";
  for (int i = 0; i < 1000; ++i) {
    cloud.push(0.37f * static_cast<float>(i) - 100.0f, 1.0f / static_cast<float>(i + 1), -2.5f,
               static_cast<std::uint8_t>(i % 256), static_cast<std::uint8_t>(i % 16),
               1e-4f * static_cast<float>(i));
  }
  cloud.x[7] = cloud.y[7] = cloud.z[7] = NAN;
  return cloud;
}

TEST(Foxglove, CloudKeepsEveryPointWithinHalfAStep) {
  const PointCloud cloud = sampleCloud();
  const auto back = foxglove::decodePointCloud(foxglove::encode(cloud));
  ASSERT_TRUE(back) << back.error();
  ASSERT_EQ(back->size(), cloud.size());
  EXPECT_EQ(back->stamp, cloud.stamp);
  EXPECT_EQ(back->frame, "lidar");
  EXPECT_EQ(back->intensity, cloud.intensity);
  EXPECT_EQ(back->ring, cloud.ring);
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    EXPECT_NEAR(back->time_offset_s[i], cloud.time_offset_s[i], 2e-6);
    if (i == 7) {
      EXPECT_TRUE(std::isnan(back->x[i]));
      continue;
    }
    EXPECT_NEAR(back->x[i], cloud.x[i], 0.5 * foxglove::kCloudStep_m + 1e-6);
    EXPECT_NEAR(back->y[i], cloud.y[i], 0.5 * foxglove::kCloudStep_m + 1e-6);
  }
}

TEST(Foxglove, CutOrDamagedCloudIsRefusedOrSmaller) {
  const std::string bytes = foxglove::encode(sampleCloud());
  for (std::size_t n = 0; n < bytes.size(); n += 41) {
    const auto back = foxglove::decodePointCloud(std::string_view(bytes).substr(0, n));
    EXPECT_TRUE(!back || back->size() <= 1000u);
  }
}

/// Names and numbers are those that the viewers know.
TEST(Foxglove, SchemasHaveTheWellKnownNumbers) {
  const auto field = [](const char* message, const char* name) {
    (void)protobufSchema(message);  // links the descriptors
    const auto* found = pb::DescriptorPool::generated_pool()->FindMessageTypeByName(message);
    return found && found->FindFieldByName(name) ? found->FindFieldByName(name)->number() : 0;
  };
  EXPECT_EQ(field("foxglove.PointCloud", "point_stride"), 4);
  EXPECT_EQ(field("foxglove.PointCloud", "data"), 6);
  EXPECT_EQ(field("foxglove.RawImage", "frame_id"), 7);
  EXPECT_EQ(field("foxglove.RawImage", "step"), 5);
  EXPECT_EQ(field("foxglove.CompressedImage", "frame_id"), 4);
  EXPECT_EQ(field("foxglove.CompressedImage", "data"), 2);
  EXPECT_EQ(field("foxglove.FrameTransform", "rotation"), 5);
  EXPECT_EQ(field("foxglove.Log", "message"), 3);
  EXPECT_EQ(field("foxglove.PoseInFrame", "pose"), 3);
}

TEST(RecordSchemas, EveryPublishedTopicHasOneThatStandsAlone) {
  for (const TopicInfo& info : topicTable()) {
    const auto schema = protobufSchema(run::schemaName(info.topic));
    ASSERT_TRUE(schema) << info.name << ": " << schema.error();
    pb::FileDescriptorSet files;
    ASSERT_TRUE(files.ParseFromString(schema->data));
    pb::DescriptorPool pool;  // an empty one, as a reader has it
    for (const auto& file : files.file()) ASSERT_NE(pool.BuildFile(file), nullptr) << info.name;
    EXPECT_NE(pool.FindMessageTypeByName(schema->name), nullptr) << info.name;
    EXPECT_EQ(run::publishedTopic(run::topicName(info.topic)), info.topic);
  }
  EXPECT_FALSE(protobufSchema("kiln.v1.Nothing"));
}

TEST(JpegSize, ReadsTheFrameHeaderAndRefusesTheRest) {
  const unsigned char jpeg[] = {0xFF, 0xD8, 0xFF, 0xE0, 0,    4,    1,    2, 0xFF, 0xC0,
                                0,    17,   8,    0x00, 0xF0, 0x01, 0x40, 3, 1,    0x22};
  const std::string_view bytes(reinterpret_cast<const char*>(jpeg), sizeof jpeg);
  const auto size = jpegSize(bytes);
  ASSERT_TRUE(size);
  EXPECT_EQ(size->width, 320);
  EXPECT_EQ(size->height, 240);
  for (std::size_t n = 0; n < 17; ++n) EXPECT_FALSE(jpegSize(bytes.substr(0, n))) << n;
  EXPECT_FALSE(jpegSize("PNG is something else"));
}

TEST(DeviceSample, SurvivesTheWayAndRefusesNaN) {
  DeviceSample sample;
  sample.stamp = stampFromNanoseconds(42);
  sample.arm.emplace().q[3] = 1.25;
  sample.base.emplace().wheels[2].drive_angle_rad = -7.5;
  sample.gripper.emplace().on.set(5);
  sample.gripper->current_a[5] = 0.35;
  sample.storage.emplace().compartments = {{0.1, 0.2, 0.5, true, false},
                                           {-0.3, -0.3, 0.1, false, true}};
  sample.X_odom_base = {1, 2, 3};
  sample.resets = 2;
  const auto back = wire::decodeDeviceSample(wire::encode(sample));
  ASSERT_TRUE(back) << back.error();
  EXPECT_EQ(back->stamp, sample.stamp);
  EXPECT_EQ(back->arm->q[3], 1.25);
  EXPECT_EQ(back->base->wheels[2].drive_angle_rad, -7.5);
  EXPECT_FALSE(back->pumps);
  EXPECT_TRUE(back->gripper->on[5]);
  EXPECT_EQ(back->gripper->on.count(), 1u);
  EXPECT_EQ(back->gripper->current_a[5], 0.35);
  ASSERT_EQ(back->storage->compartments.size(), 2u);
  EXPECT_EQ(back->storage->compartments[0].target_m, 0.2);
  EXPECT_TRUE(back->storage->compartments[1].blocked);
  EXPECT_EQ(back->X_odom_base.yaw_rad, 3.0);
  EXPECT_EQ(back->resets, 2u);
  sample.base->wheels[0].steer_rad = NAN;
  EXPECT_FALSE(wire::decodeDeviceSample(wire::encode(sample)));
  EXPECT_FALSE(wire::decodeDeviceSample("\xff\xff\xff"));
  sample.base.reset();
  sample.storage->compartments[0].position_m = NAN;
  EXPECT_FALSE(wire::decodeDeviceSample(wire::encode(sample)));
}

}  // namespace
}  // namespace kiln
