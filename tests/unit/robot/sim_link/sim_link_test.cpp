#include "robot/sim_link/sim_link.h"

#include <atomic>
#include <cmath>
#include <filesystem>
#include <functional>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>
#include <zmq.hpp>

#include "kiln/v1/device.pb.h"

namespace kiln {
namespace {

using ::testing::HasSubstr;
using namespace v1::device;

/// The other end: answers each message by a function, on a thread of its own.
class FakeWorld {
 public:
  using Answer = std::function<std::optional<ToRobot>(const ToWorld&)>;
  FakeWorld(std::string endpoint, Answer answer)
      : endpoint_(std::move(endpoint)), answer_(std::move(answer)) {
    socket_.set(zmq::sockopt::linger, 0);
    socket_.bind(endpoint_);
    thread_ = std::jthread([this](std::stop_token stop) { run(stop); });
  }
  std::atomic<int> byes{0};

 private:
  void run(std::stop_token stop) {
    while (!stop.stop_requested()) {
      zmq::pollitem_t item{socket_.handle(), 0, ZMQ_POLLIN, 0};
      zmq::poll(&item, 1, std::chrono::milliseconds(20));
      zmq::message_t id, body;
      if (!socket_.recv(id, zmq::recv_flags::dontwait)) continue;
      (void)socket_.recv(body, zmq::recv_flags::none);
      ToWorld message;
      ASSERT_TRUE(message.ParseFromArray(body.data(), static_cast<int>(body.size())));
      if (message.has_bye()) ++byes;
      if (const auto answer = answer_(message)) {
        socket_.send(id, zmq::send_flags::sndmore);
        socket_.send(zmq::buffer(answer->SerializeAsString()), zmq::send_flags::none);
      }
    }
  }
  std::string endpoint_;
  Answer answer_;
  zmq::context_t context_{1};
  zmq::socket_t socket_{context_, zmq::socket_type::router};
  std::jthread thread_;
};

ToRobot welcome(bool lockstep) {
  ToRobot m;
  m.mutable_hello()->set_accepted(true);
  m.mutable_hello()->set_now_ns(5'000'000'000);
  m.mutable_hello()->set_lockstep(lockstep);
  m.mutable_hello()->set_device_period_s(0.008);
  m.mutable_hello()->set_world("fake");
  m.mutable_hello()->set_seed(7);
  return m;
}

ToRobot reportAt(std::int64_t now_ns) {
  ToRobot m;
  Report& r = *m.mutable_report();
  r.set_now_ns(now_ns);
  for (int i = 0; i < 6; ++i) {
    r.mutable_arm()->add_q_rad(0.1 * i);
    r.mutable_arm()->add_qd_radps(0);
    r.mutable_arm()->add_wrench(0);
  }
  for (int i = 0; i < 4; ++i) r.mutable_base()->add_wheels()->set_drive_radps(i);
  for (int i = 0; i < 2; ++i) {
    r.mutable_pumps()->add_duty(0);
    r.mutable_pumps()->add_current_a(3);
  }
  r.set_resets(2);
  return m;
}

struct SimLinkTest : ::testing::Test {
  SimLinkTest() {
    directory = std::filesystem::path(::testing::TempDir()) / ("kiln" + std::to_string(::getpid()));
    std::filesystem::create_directories(directory);
    config.endpoint = "ipc://" + (directory / "world").string();
    config.version = "1";
    config.lockstep = true;
    config.hello_timeout_s = 5.0;
  }
  ~SimLinkTest() override { std::filesystem::remove_all(directory); }
  std::filesystem::path directory;
  SimLink::Config config;
  ManualClock clock;
};

TEST_F(SimLinkTest, LockstepSendsTheBufferedCommandsAndTakesTheReport) {
  std::atomic<int> servos{0}, with_lidar{0};
  FakeWorld world(config.endpoint, [&](const ToWorld& m) -> std::optional<ToRobot> {
    if (m.has_hello()) return welcome(true);
    if (!m.has_advance()) return std::nullopt;
    servos += m.advance().has_arm() ? 1 : 0;
    with_lidar += m.advance().sensors().lidar() ? 1 : 0;
    return reportAt(m.advance().until_ns());
  });
  auto link = SimLink::connect(config, clock);
  ASSERT_TRUE(link.has_value()) << link.error();
  EXPECT_EQ((*link)->world().seed, 7u);
  EXPECT_EQ(toSeconds((*link)->world().now), 5.0);
  EXPECT_FALSE((*link)->arm().state().has_value());
  ASSERT_TRUE((*link)->lidar().start([](PointCloudPtr) {}).has_value());
  ASSERT_TRUE((*link)->arm().servo({}).has_value());
  ASSERT_TRUE((*link)->arm().servo({}).has_value());  // the newest target counts, once
  ASSERT_TRUE((*link)->advanceTo(stampFromNanoseconds(5'008'000'000)).has_value());
  ASSERT_TRUE((*link)->advanceTo(stampFromNanoseconds(5'016'000'000)).has_value());
  EXPECT_EQ(servos, 1);
  EXPECT_EQ(with_lidar, 1);
  EXPECT_EQ(toNanoseconds((*link)->arm().state()->stamp), 5'016'000'000);
  EXPECT_DOUBLE_EQ((*link)->arm().state()->q[3], 0.3);
  EXPECT_DOUBLE_EQ((*link)->base().state()->wheels[2].drive_radps, 2.0);
  EXPECT_DOUBLE_EQ((*link)->pumps().state()->current_a[1], 3.0);
  EXPECT_EQ((*link)->resets(), 2u);
}

TEST_F(SimLinkTest, WhatIsCommandedWhileTheWorldMovesGoesWithTheNextStep) {
  std::vector<bool> with_arm;
  FakeWorld world(config.endpoint, [&](const ToWorld& m) -> std::optional<ToRobot> {
    if (m.has_hello()) return welcome(true);
    if (!m.has_advance()) return std::nullopt;
    with_arm.push_back(m.advance().has_arm());
    return reportAt(m.advance().until_ns());
  });
  auto link = SimLink::connect(config, clock);
  ASSERT_TRUE(link.has_value()) << link.error();
  ASSERT_TRUE((*link)->beginStep(stampFromNanoseconds(5'008'000'000)).has_value());
  ASSERT_TRUE((*link)->arm().servo({}).has_value());
  ASSERT_TRUE((*link)->finishStep().has_value());
  ASSERT_TRUE((*link)->advanceTo(stampFromNanoseconds(5'016'000'000)).has_value());
  EXPECT_EQ(with_arm, (std::vector<bool>{false, true}));
  EXPECT_EQ(toNanoseconds((*link)->arm().state()->stamp), 5'016'000'000);
}

TEST_F(SimLinkTest, CommandsThatAreNotFiniteAreNeverSent) {
  FakeWorld world(config.endpoint, [](const ToWorld& m) -> std::optional<ToRobot> {
    return m.has_hello() ? std::optional(welcome(true)) : std::nullopt;
  });
  auto link = SimLink::connect(config, clock);
  ASSERT_TRUE(link.has_value()) << link.error();
  kiln::ArmServo bad;
  bad.q[2] = std::nan("");
  EXPECT_FALSE((*link)->arm().servo(bad).has_value());
  kiln::WheelCommands wheels{};
  wheels[1].drive_radps = INFINITY;
  EXPECT_FALSE((*link)->base().write(wheels).has_value());
  EXPECT_FALSE((*link)->pumps().write({std::nan(""), 0}).has_value());
}

TEST_F(SimLinkTest, RefusalsComeInTheWorldsWords) {
  for (const auto& [refusal, code] : {std::pair{REFUSAL_VERSION, ErrorCode::VersionMismatch},
                                      std::pair{REFUSAL_BUSY, ErrorCode::Refused}}) {
    FakeWorld world(config.endpoint,
                    [refusal = refusal](const ToWorld& m) -> std::optional<ToRobot> {
                      if (!m.has_hello()) return std::nullopt;
                      ToRobot answer;
                      answer.mutable_hello()->set_refusal(refusal);
                      answer.mutable_hello()->set_reason("because of reasons");
                      return answer;
                    });
    const auto link = SimLink::connect(config, clock);
    ASSERT_FALSE(link.has_value());
    EXPECT_EQ(link.error().code, code);
    EXPECT_THAT(link.error().message, HasSubstr("because of reasons"));
  }
}

TEST_F(SimLinkTest, NobodyThereIsUnavailable) {
  config.hello_timeout_s = 0.2;
  const auto link = SimLink::connect(config, clock);
  ASSERT_FALSE(link.has_value());
  EXPECT_EQ(link.error().code, ErrorCode::Unavailable);
  EXPECT_THAT(link.error().message, HasSubstr(config.endpoint));
}

TEST_F(SimLinkTest, AddressesBeyondThisMachineAreRefused) {
  for (const char* bad : {"tcp://192.168.1.2:5555", "tcp://0.0.0.0:1", "udp://x", "ipc://", ""}) {
    config.endpoint = bad;
    const auto link = SimLink::connect(config, clock);
    ASSERT_FALSE(link.has_value()) << bad;
    EXPECT_EQ(link.error().code, ErrorCode::InvalidInput) << bad;
  }
}

TEST_F(SimLinkTest, WorldThatEndsInAStepIsAnErrorAndCommandsAreRefused) {
  auto world =
      std::make_unique<FakeWorld>(config.endpoint, [](const ToWorld& m) -> std::optional<ToRobot> {
        return m.has_hello() ? std::optional(welcome(true)) : std::nullopt;  // never answers a step
      });
  auto link = SimLink::connect(config, clock);
  ASSERT_TRUE(link.has_value()) << link.error();
  EXPECT_TRUE((*link)->connected());
  world.reset();
  const auto step = (*link)->advanceTo(stampFromNanoseconds(5'008'000'000));
  ASSERT_FALSE(step.has_value());
  EXPECT_EQ(step.error().code, ErrorCode::Unavailable);
  EXPECT_FALSE((*link)->connected());
  EXPECT_FALSE((*link)->arm().servo({}).has_value());
}

TEST_F(SimLinkTest, SaysByeAtTheEnd) {
  FakeWorld world(config.endpoint, [](const ToWorld& m) -> std::optional<ToRobot> {
    return m.has_hello() ? std::optional(welcome(true)) : std::nullopt;
  });
  {
    auto link = SimLink::connect(config, clock);
    ASSERT_TRUE(link.has_value()) << link.error();
  }
  for (int i = 0; i < 200 && world.byes == 0; ++i) std::this_thread::yield();
  // The bye is in the socket before the destructor returns (linger); the fake reads it at its next
  // poll.
  zmq::pollitem_t none{nullptr, -1, 0, 0};
  for (int i = 0; i < 100 && world.byes == 0; ++i)
    zmq::poll(&none, 0, std::chrono::milliseconds(10));
  EXPECT_EQ(world.byes, 1);
}

TEST_F(SimLinkTest, RealTimeReportsArriveByThemselvesInTheDaemonsClock) {
  config.lockstep = false;
  FakeWorld world(config.endpoint, [](const ToWorld& m) -> std::optional<ToRobot> {
    if (m.has_hello()) return welcome(false);
    return m.has_advance() ? std::optional(reportAt(7'000'000'000))
                           : std::nullopt;  // one per command
  });
  clock.advanceTo(stampFromNanoseconds(100'000'000'000));
  auto link = SimLink::connect(config, clock);
  ASSERT_TRUE(link.has_value()) << link.error();
  std::atomic<bool> got{false};
  ASSERT_TRUE((*link)->base().write({}).has_value());
  for (int i = 0; i < 1000 && !(*link)->base().state(); ++i) {
    zmq::pollitem_t none{nullptr, -1, 0, 0};
    zmq::poll(&none, 0, std::chrono::milliseconds(5));
  }
  ASSERT_TRUE((*link)->base().state().has_value());
  EXPECT_EQ((*link)->base().state()->stamp, clock.now());
  clock.advanceBy(std::chrono::seconds(2));  // silence, by the daemon's clock
  for (int i = 0; i < 1000 && (*link)->connected(); ++i) {
    zmq::pollitem_t none{nullptr, -1, 0, 0};
    zmq::poll(&none, 0, std::chrono::milliseconds(5));
  }
  // The lost world answers the next hello: the link comes back by itself.
  for (int i = 0; i < 1000 && (*link)->reconnects() == 0; ++i) {
    zmq::pollitem_t none{nullptr, -1, 0, 0};
    zmq::poll(&none, 0, std::chrono::milliseconds(5));
  }
  EXPECT_GE((*link)->reconnects(), 1u);
  EXPECT_TRUE((*link)->connected());
}

}  // namespace
}  // namespace kiln
