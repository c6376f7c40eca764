#include "robot/sim/world_server.h"

#include <filesystem>
#include <fstream>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <unistd.h>
#include <zmq.hpp>

#include "common/config/resources.h"
#include "kiln/v1/device.pb.h"
#include "robot/sim_link/sim_link.h"

namespace kiln::sim {
namespace {

using ::testing::HasSubstr;

struct WorldServerTest : ::testing::Test {
  WorldServerTest() {
    directory =
        std::filesystem::path(::testing::TempDir()) / ("kilnworld" + std::to_string(::getpid()));
    std::filesystem::create_directories(directory);
    config.endpoint = "ipc://" + (directory / "world").string();
    config.lockstep = true;
    config.version = "1";
    config.truth_path = (directory / "truth.json").string();
    world = std::move(*World::create({}, 1));
    link_config.endpoint = config.endpoint;
    link_config.lockstep = true;
    link_config.version = "1";
  }
  ~WorldServerTest() override {
    stop.store(true);
    thread = {};
    std::filesystem::remove_all(directory);
  }
  void serve() {
    auto created = WorldServer::create(config, *world, clock);
    ASSERT_TRUE(created.has_value()) << created.error();
    server = std::move(*created);
    thread = std::jthread([this] { EXPECT_TRUE(server->run(stop).has_value()); });
  }
  std::filesystem::path directory;
  WorldServer::Config config;
  SimLink::Config link_config;
  SteadyClock clock;
  std::unique_ptr<World> world;
  std::unique_ptr<WorldServer> server;
  std::atomic<bool> stop{false};
  std::jthread thread;
};

TEST_F(WorldServerTest, LockstepStepsAnswersAndWritesTheTruthAtBye) {
  serve();
  {
    auto link = SimLink::connect(link_config, clock);
    ASSERT_TRUE(link.has_value()) << link.error();
    for (int i = 1; i <= 50; ++i) {
      ASSERT_TRUE((*link)->pumps().write({1.0, 1.0}).has_value());
      ASSERT_TRUE((*link)->advanceTo(stampFromNanoseconds(i * 20'000'000LL)).has_value());
    }
    EXPECT_EQ(toSeconds((*link)->arm().state()->stamp), 1.0);
    EXPECT_EQ((*link)->pumps().state()->duty[0], 1.0);
  }
  stop.store(true);
  thread.join();
  std::ifstream file(config.truth_path);
  const auto truth = nlohmann::json::parse(file);
  EXPECT_DOUBLE_EQ(truth["simulated_s"], 1.0);
  EXPECT_EQ(truth["litres_delivered"].size(), 2u);
  EXPECT_GT(truth["pump_on_s"].get<double>(), 0.9);
}

TEST_F(WorldServerTest, TellsWhatTheRobotLacksAndKeepsIt) {
  config.devices = {DeviceKind::Lidar};
  serve();
  auto link = SimLink::connect(link_config, clock);
  ASSERT_TRUE(link.has_value()) << link.error();
  EXPECT_EQ((*link)->world().devices, config.devices);
  int scans = 0, images = 0;
  ASSERT_TRUE((*link)->lidar().start([&](const PointCloudPtr&) { ++scans; }).has_value());
  ASSERT_TRUE(
      (*link)->thermalCamera().start([&](const ThermalImagePtr&) { ++images; }).has_value());
  for (int i = 1; i <= 50; ++i) {
    ASSERT_TRUE((*link)->pumps().write({1.0, 1.0}).has_value());
    ASSERT_TRUE((*link)->advanceTo(stampFromNanoseconds(i * 20'000'000LL)).has_value());
  }
  EXPECT_GT(scans, 5);
  EXPECT_EQ(images, 0);
  EXPECT_FALSE((*link)->pumps().state().has_value());
  EXPECT_TRUE((*link)->arm().state().has_value());
  EXPECT_EQ(world->truth().fire.pump_on_s, 0.0);
}

TEST_F(WorldServerTest, GripperStorageAndHeadCameraOfAWallsRobot) {
  WorldConfig lab = *WorldConfig::load(*resourcePath("worlds/wall_lab.yaml"));
  lab.head_camera.width = 320;
  lab.head_camera.height = 180;
  world = std::move(*World::create(lab, 1));
  config.devices = world->devices();
  serve();
  auto link = SimLink::connect(link_config, clock);
  ASSERT_TRUE(link.has_value()) << link.error();
  EXPECT_EQ((*link)->world().devices, (DeviceSet{DeviceKind::Lidar, DeviceKind::HeadCamera,
                                                 DeviceKind::Gripper, DeviceKind::Storage}));
  std::vector<RgbImagePtr> pictures;
  ASSERT_TRUE((*link)
                  ->headCamera()
                  .start([&](const RgbImagePtr& picture) { pictures.push_back(picture); })
                  .has_value());
  MagnetMask on;
  on.set(0).set(7);
  ASSERT_TRUE((*link)->gripper().write(on).has_value());
  for (int i = 1; i <= 100; ++i) {
    ASSERT_TRUE((*link)->storage().write(std::vector<double>{0.05}).has_value());
    ASSERT_TRUE((*link)->advanceTo(stampFromNanoseconds(i * 20'000'000LL)).has_value());
  }
  const auto gripper = (*link)->gripper().state();
  ASSERT_TRUE(gripper.has_value());
  EXPECT_EQ(gripper->on, on);
  EXPECT_GT(gripper->current_a[7], 0.2);
  EXPECT_LT(gripper->current_a[3], 0.1);
  EXPECT_FALSE(gripper->contact);
  const auto storage = (*link)->storage().state();
  ASSERT_TRUE(storage.has_value());
  ASSERT_EQ(storage->compartments.size(), 1U);
  EXPECT_NEAR(storage->compartments[0].position_m, 0.05, 0.002);
  EXPECT_NEAR(static_cast<double>(pictures.size()), 20.0, 2.0);
  EXPECT_EQ(pictures.back()->frame, "rgb");
  EXPECT_EQ(pictures.back()->width, 320);
  ASSERT_TRUE((*link)->storage().write(std::vector<double>{2.0}).has_value());
  ASSERT_TRUE((*link)->advanceTo(stampFromNanoseconds(2'020'000'000LL)).has_value());
  EXPECT_THAT((*link)->refusal(), HasSubstr("compartment 1"));
  EXPECT_FALSE((*link)->storage().write(std::vector<double>{std::nan("")}).has_value());
}

TEST_F(WorldServerTest, SecondRobotIsRefusedInWords) {
  serve();
  auto first = SimLink::connect(link_config, clock);
  ASSERT_TRUE(first.has_value()) << first.error();
  const auto second = SimLink::connect(link_config, clock);
  ASSERT_FALSE(second.has_value());
  EXPECT_EQ(second.error().code, ErrorCode::Refused);
  EXPECT_THAT(second.error().message, HasSubstr("another kiln-robotd"));
  EXPECT_TRUE((*first)->advanceTo(stampFromNanoseconds(8'000'000)).has_value());
}

TEST_F(WorldServerTest, OtherVersionAndOtherModeAreRefused) {
  serve();
  link_config.version = "2";
  const auto other = SimLink::connect(link_config, clock);
  ASSERT_FALSE(other.has_value());
  EXPECT_EQ(other.error().code, ErrorCode::VersionMismatch);
  link_config.version = "1";
  link_config.lockstep = false;
  const auto live = SimLink::connect(link_config, clock);
  ASSERT_FALSE(live.has_value());
  EXPECT_THAT(live.error().message, HasSubstr("lockstep"));
}

TEST_F(WorldServerTest, RobotThatVanishesLeavesAWorldThatTheNextOneFindsAsItStands) {
  serve();
  {  // like kill -9: no bye, the kernel closes the connection
    zmq::context_t context;
    zmq::socket_t socket(context, zmq::socket_type::dealer);
    socket.set(zmq::sockopt::linger, 0);
    socket.connect(config.endpoint);
    v1::device::ToWorld hello, advance;
    hello.mutable_hello()->set_protocol(v1::device::PROTOCOL_CURRENT);
    hello.mutable_hello()->set_lockstep(true);
    hello.mutable_hello()->set_version("1");
    socket.send(zmq::buffer(hello.SerializeAsString()));
    advance.mutable_advance()->set_until_ns(2'000'000'000);
    advance.mutable_advance()->mutable_pumps()->set_left(1.0);
    socket.send(zmq::buffer(advance.SerializeAsString()));
    zmq::message_t reply, report;
    ASSERT_TRUE(socket.recv(reply));
    ASSERT_TRUE(socket.recv(report));
  }
  auto next = SimLink::connect(link_config, clock);
  ASSERT_TRUE(next.has_value()) << next.error();
  EXPECT_EQ(toSeconds((*next)->world().now), 2.0);
  ASSERT_TRUE((*next)->advanceTo(stampFromNanoseconds(2'008'000'000)).has_value());
  EXPECT_EQ((*next)->pumps().state()->duty[0],
            0.0);  // cut by the device, 200 ms after the only heartbeat
  EXPECT_TRUE((*next)->pumps().state()->heartbeat_lost);
}

TEST_F(WorldServerTest, AddressInUseOrNotLocalIsOneSentence) {
  serve();
  const auto second = WorldServer::create(config, *world, clock);
  ASSERT_FALSE(second.has_value());
  EXPECT_EQ(second.error().code, ErrorCode::Unavailable);
  EXPECT_THAT(second.error().message, HasSubstr("in use"));
  config.endpoint = "tcp://0.0.0.0:5555";
  const auto open = WorldServer::create(config, *world, clock);
  ASSERT_FALSE(open.has_value());
  EXPECT_EQ(open.error().code, ErrorCode::InvalidInput);
}

TEST_F(WorldServerTest, BytesOfAnotherProtocolAreIgnored) {
  serve();
  zmq::context_t context;
  zmq::socket_t socket(context, zmq::socket_type::dealer);
  socket.set(zmq::sockopt::linger, 0);
  socket.connect(config.endpoint);
  for (const std::string& bytes :
       {std::string("GET / HTTP/1.0"), std::string(300, '\xff'), std::string()}) {
    socket.send(zmq::buffer(bytes));
  }
  auto link = SimLink::connect(link_config, clock);
  ASSERT_TRUE(link.has_value()) << link.error();
  EXPECT_TRUE((*link)->advanceTo(stampFromNanoseconds(8'000'000)).has_value());
}

}  // namespace
}  // namespace kiln::sim
