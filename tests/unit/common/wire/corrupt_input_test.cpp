#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/wire/cloud_codec.h"
#include "common/wire/command.h"
#include "common/wire/compress.h"
#include "common/wire/fire/codec/fire_codec.h"
#include "common/wire/fire/codec/protocol2.h"
#include "common/wire/fsm.h"
#include "common/wire/localization.h"
#include "common/wire/mission.h"
#include "common/wire/sensor.h"
#include "common/wire/telemetry.h"
#include "common/wire/world.h"

namespace kiln::wire {
namespace {

using ::testing::HasSubstr;

PointCloud someCloud() {
  PointCloud cloud;
  cloud.frame = "lidar";
  for (int i = 0; i < 300; ++i) {
    cloud.push(0.01f * static_cast<float>(i), 1.0f, 2.0f, 9, static_cast<std::uint8_t>(i % 16),
               1e-5f);
  }
  return cloud;
}
ThermalImage someThermal() {
  ThermalImage image;
  image.width = 16;
  image.height = 12;
  image.counts.assign(16 * 12, 29815);
  return image;
}

/// Every decoder on one input: none may crash, hang or allocate beyond its cap. @return how many
/// took it.
int feedAll(std::string_view bytes) {
  return static_cast<int>(decodeCloud(bytes).has_value()) +
         static_cast<int>(decodeThermal(bytes).has_value()) +
         static_cast<int>(decodeJpeg(bytes).has_value()) +
         static_cast<int>(decodeHeat(bytes).has_value()) +
         static_cast<int>(decodeFireSite(bytes).has_value()) +
         static_cast<int>(decodeMissionInfo(bytes).has_value()) +
         static_cast<int>(decodeMissionDetail(bytes).has_value()) +
         static_cast<int>(protocol2::upgradeStatus(bytes).has_value()) +
         static_cast<int>(protocol2::upgradeScene(bytes).has_value()) +
         static_cast<int>(protocol2::upgradeMacros(bytes).has_value()) +
         static_cast<int>(protocol2::missionInfo(bytes).has_value()) +
         static_cast<int>(decodeScene(bytes).has_value()) +
         static_cast<int>(decodeFsmInfo(bytes).has_value()) +
         static_cast<int>(decodeFsmStatus(bytes).has_value()) +
         static_cast<int>(decodeToRobot(bytes).has_value()) +
         static_cast<int>(decodeToStation(bytes).has_value()) +
         static_cast<int>(decodeStopRequest(bytes).has_value()) +
         static_cast<int>(decodeStopAck(bytes).has_value()) +
         static_cast<int>(decodeRobotStatus(bytes).has_value()) +
         static_cast<int>(decodeLocalization(bytes).has_value()) +
         static_cast<int>(decodeMapLayer(bytes).has_value()) +
         static_cast<int>(decodeTrajectory(bytes).has_value()) +
         static_cast<int>(decodeMacros(bytes).has_value()) +
         static_cast<int>(decodeLogBatch(bytes).has_value());
}

TEST(CorruptInput, RandomBytesAreNeverACrash) {
  std::mt19937_64 random(1);
  for (int round = 0; round < 3000; ++round) {
    std::string bytes(random() % 200, '\0');
    for (char& c : bytes) c = static_cast<char>(random());
    feedAll(bytes);
  }
}

TEST(CorruptInput, FlippedAndCutMessagesAreNeverACrash) {
  std::mt19937_64 random(2);
  RobotStatus status;
  status.alarms.push_back({});
  Command command;
  command.client_id = "c";
  command.body = JogArm{};
  MapLayer layer;
  layer.points_map.assign(300, Eigen::Vector3f(1, 2, 3));
  const Trajectory driven{{}, {{0, {{1, 2, 0.5}}}}};
  FsmInfo info{"fire", "uuid", "Start", {FsmStateInfo{}}, {FsmEdgeInfo{}}};
  const std::vector<std::string> good{encode(someCloud(), 0.005),
                                      encode(someThermal()),
                                      encode(status),
                                      encode(info),
                                      encode(ToRobot{command}),
                                      encode(layer),
                                      encode(driven),
                                      encode(LocalizationStatus{})};
  for (int round = 0; round < 4000; ++round) {
    std::string bytes = good[static_cast<std::size_t>(round) % good.size()];
    for (int flips = 1 + static_cast<int>(random() % 4); flips > 0; --flips) {
      bytes[random() % bytes.size()] ^= static_cast<char>(1u << (random() % 8));
    }
    if (round % 3 == 0) bytes.resize(random() % bytes.size());
    feedAll(bytes);
  }
}

TEST(CorruptInput, DeclaredSizesAreCheckedBeforeTheyAreAllocated) {
  v1::Cloud packed = packCloud(someCloud(), 0.005);
  packed.set_points(kMaxCloudPoints);  // claims more than its planes hold
  const auto more = unpackCloud(packed);
  ASSERT_FALSE(more.has_value());
  EXPECT_THAT(more.error().message, HasSubstr("are due"));
  packed.set_points(kMaxCloudPoints + 1);
  EXPECT_FALSE(unpackCloud(packed).has_value());
  packed.set_points(300);
  // A small frame that would unpack to 100 MB.
  packed.set_ring(compress(std::string(100'000'000, '\1')));
  EXPECT_LT(packed.ring().size(), 20'000u);
  EXPECT_FALSE(unpackCloud(packed).has_value());
}

TEST(CorruptInput, ResolutionsThatCannotBeAreRefused) {
  v1::Cloud packed = packCloud(someCloud(), 0.005);
  for (const double wrong : {0.0, -1.0, 1e9, std::nan("")}) {
    packed.set_resolution_m(wrong);
    EXPECT_FALSE(unpackCloud(packed).has_value()) << wrong;
  }
}

TEST(CorruptInput, ListsThatNobodyCouldShowAreRefusedByTheirCount) {
  Scene scene;
  scene.items.resize(2000);
  EXPECT_TRUE(decodeScene(encode(scene)).has_value());
  scene.items.resize(2001);
  const auto items = decodeScene(encode(scene));
  ASSERT_FALSE(items.has_value());
  EXPECT_THAT(items.error().message, HasSubstr("2001 rows of items are more than 2000"));
  scene.items.resize(1);
  scene.items[0].points.resize(2001);  // however deep
  EXPECT_FALSE(decodeScene(encode(scene)).has_value());

  RobotStatus status;
  status.operators.resize(2001);  // texts too
  EXPECT_FALSE(decodeRobotStatus(encode(status)).has_value());

  FsmInfo graph;
  graph.states.resize(256);
  EXPECT_TRUE(decodeFsmInfo(encode(graph)).has_value());
  graph.states.resize(257);
  const auto states = decodeFsmInfo(encode(graph));
  ASSERT_FALSE(states.has_value());
  EXPECT_THAT(states.error().message, HasSubstr("257 states are more than 256"));
}

TEST(CorruptInput, CutFramesSaySo) {
  const std::string packed = compress(std::string(1000, 'x'));
  const auto cut =
      decompress(std::string_view(packed).substr(0, packed.size() - 3), 1000, "thermal image");
  ASSERT_FALSE(cut.has_value());
  EXPECT_THAT(cut.error().message, HasSubstr("thermal image"));
}

TEST(CorruptInput, UnknownCommandKindsAreNamedAsVersionTrouble) {
  // ToRobot { command { client_id: "c", nonce: 7 } } without a body, as a newer peer's unknown kind
  // arrives.
  const std::string bytes(
      "\x1a\x05\x0a\x01"
      "c"
      "\x18\x07",
      7);
  const auto command = decodeToRobot(bytes);
  ASSERT_FALSE(command.has_value());
  EXPECT_THAT(command.error().message, HasSubstr("same version"));
}

}  // namespace
}  // namespace kiln::wire
