#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/transport/robot_end.h"
#include "common/transport/station_end.h"
#include "common/wire/command.h"
#include "tests/support/raw_zmtp.h"
#include "tests/system/two_ends.h"

namespace kiln::test {
namespace {

using ::testing::HasSubstr;

TEST(OperatorLink, CarriesStatusGraphAndCloudToAStation) {
  const TempFolder folder;
  LinkedRobot robot(folder.endpoint());
  robot.link->publish(
      FsmInfo{"fire", "uuid", "Start", {}, {}});  // latched: before anybody is there
  LinkedOperator op(operatorConfig(folder.endpoint(), "anna"));
  ASSERT_TRUE(connected(robot, op));
  auto cloud = std::make_shared<PointCloud>();
  cloud->frame = "lidar";
  cloud->push(1.0f, -2.0f, 0.5f, 40, 3, 0.01f);
  ASSERT_TRUE(tickUntil(robot, [&] {
    robot.link->publish(PointCloudPtr(cloud));
    const std::lock_guard lock(op.mutex);
    return op.received[Topic::RobotStatus] > 0 && op.received[Topic::FsmInfo] > 0 &&
           op.cloud != nullptr;
  }));
  const std::lock_guard lock(op.mutex);
  EXPECT_EQ(op.fsm_info.mission, "fire");
  EXPECT_NEAR(op.cloud->y.at(0), -2.0, 0.0026);
  EXPECT_EQ(robot.link->operators().at(0).name, "anna");
}

TEST(OperatorLink, NoOtherSubscriberSwitchesTelemetryOffOrOn) {
  const TempFolder folder;
  LinkedRobot robot(folder.endpoint());
  const auto addresses = parseEndpoint(folder.endpoint());
  ASSERT_TRUE(addresses.has_value());
  {
    RawZmtp wrong_port(addresses->status);
    ASSERT_TRUE(wrong_port.shakeHands("SUB") && wrong_port.send("\1operator_camera"));
    RawZmtp right_port(addresses->streams);
    ASSERT_TRUE(right_port.shakeHands("SUB") && right_port.send("\1rgb\1head_camera"));
    EXPECT_FALSE(tickUntil(
        robot, [&] { return robot.link->wanted("operator_camera"); }, 0.3));
  }
  LinkedOperator op(operatorConfig(folder.endpoint(), "anna"));
  ASSERT_TRUE(connected(robot, op));
  const auto bothCome = [&] {
    int before_status = 0, before_cloud = 0;
    {
      const std::lock_guard lock(op.mutex);
      before_status = op.received[Topic::RobotStatus];
      before_cloud = op.received[Topic::Cloud];
    }
    return tickUntil(
        robot,
        [&] {
          robot.link->publish(std::make_shared<const PointCloud>());
          const std::lock_guard lock(op.mutex);
          return op.received[Topic::RobotStatus] > before_status + 3 &&
                 op.received[Topic::Cloud] > before_cloud + 3;
        },
        5.0);
  };
  EXPECT_TRUE(bothCome());
  {
    RawZmtp status(addresses->status), streams(addresses->streams), wrong(addresses->status);
    ASSERT_TRUE(status.shakeHands("XSUB") && streams.shakeHands("SUB") && wrong.shakeHands("SUB"));
    for (const char first : {'\1', '\0', '\2', '\xFF'}) {
      status.send(first + std::string("robot_status"));
      streams.send(first + std::string("cloud"));
      wrong.send(first + std::string("cloud"));
    }
    EXPECT_TRUE(bothCome());
  }
  EXPECT_TRUE(bothCome());  // and they have left
}

TEST(OperatorLink, EstimatesHowFarTheOperatorsClockIsOff) {
  const TempFolder folder;
  LinkedRobot robot(folder.endpoint());
  LinkedOperator op(operatorConfig(folder.endpoint(), "anna"));
  ASSERT_TRUE(connected(robot, op));
  const LinkReport link = op.link();
  const double offset_s = toSeconds(robot.clock.now() - op.clock.now());
  EXPECT_NEAR(offset_s, 2.9, 0.01);
  EXPECT_LE(std::abs(link.clock_offset_s - offset_s), link.clock_uncertainty_s + 1e-4);
  // And the robot learns how well its clock is known there: before a start it looks at that.
  ASSERT_TRUE(tickUntil(robot, [&] {
    const auto peers = robot.link->operators();
    return peers.size() == 1 && peers[0].clock_error_s && *peers[0].clock_error_s == 0.0;
  }));
}

TEST(OperatorLink, DeniesTheSecondClientAndNamesTheHolder) {
  const TempFolder folder;
  LinkedRobot robot(folder.endpoint());
  LinkedOperator anna(operatorConfig(folder.endpoint(), "anna"));
  LinkedOperator ben(operatorConfig(folder.endpoint(), "ben"));
  ASSERT_TRUE(takeControl(robot, anna));
  ASSERT_TRUE(connected(robot, ben));
  const auto acquire = ben.session->send(AcquireLease{});
  const auto pause = ben.session->send(SetMode{Mode::Supervised});
  ASSERT_TRUE(tickUntil(robot, [&] { return ben.fate(pause).state == CommandState::Refused; }));
  EXPECT_EQ(ben.fate(acquire).code, "lease_held");
  EXPECT_EQ(ben.fate(acquire).lease_holder, "anna");
  EXPECT_EQ(ben.fate(pause).code, "no_lease");
  EXPECT_FALSE(ben.session->lease().mine);
}

TEST(OperatorLink, HandsOverWhenTheHolderReleases) {
  const TempFolder folder;
  LinkedRobot robot(folder.endpoint());
  LinkedOperator anna(operatorConfig(folder.endpoint(), "anna"));
  LinkedOperator ben(operatorConfig(folder.endpoint(), "ben"));
  ASSERT_TRUE(takeControl(robot, anna));
  ASSERT_TRUE(connected(robot, ben));
  const auto ask = ben.session->send(AcquireLease{.take_over = true});
  ASSERT_TRUE(tickUntil(robot, [&] {
    const auto status = anna.status();
    return status && status->lease.requested_by_name == "ben";
  }));
  EXPECT_EQ(ben.fate(ask).state, CommandState::Accepted);
  anna.session->send(ReleaseLease{});
  ASSERT_TRUE(
      tickUntil(robot, [&] { return ben.session->lease().mine && !anna.session->lease().mine; }));
  EXPECT_EQ(ben.fate(ask).state, CommandState::Done);
}

TEST(OperatorLink, StreamsHeldSetpointsAndSendsZeroOnRelease) {
  const TempFolder folder;
  LinkedRobot robot(folder.endpoint());
  LinkedOperator op(operatorConfig(folder.endpoint(), "anna"));
  ASSERT_TRUE(takeControl(robot, op));
  const std::uint64_t press = op.session->press();
  ASSERT_TRUE(tickUntil(robot, [&] {
    op.session->hold(JogBase{{0.3, 0.0, 0.0}}, press);
    return robot.accepted.size() >= 10;
  }));
  EXPECT_TRUE(robot.authority.held(HoldKind::BaseJog, robot.clock.now()));
  op.session->release(JogBase{});
  const auto zeros = [&] {
    return std::count_if(robot.accepted.begin(), robot.accepted.end(), [](const auto& a) {
      return std::holds_alternative<ReleaseAll>(a.command.body);
    });
  };
  ASSERT_TRUE(tickUntil(robot, [&] { return zeros() == 3; }));
  EXPECT_FALSE(robot.authority.held(HoldKind::BaseJog, robot.clock.now()));
  EXPECT_THAT(robot.released, ::testing::ElementsAre(HoldKind::BaseJog));
}

TEST(OperatorLink, ForgottenKeyIsARelease) {
  const TempFolder folder;
  LinkedRobot robot(folder.endpoint());
  LinkedOperator op(operatorConfig(folder.endpoint(), "anna"));
  ASSERT_TRUE(takeControl(robot, op));
  const std::uint64_t press = op.session->press();
  op.session->hold(HoldActuator{"pumps", 1.0}, press);  // once, and never again: a hung window
  ASSERT_TRUE(tickUntil(
      robot, [&] { return robot.authority.held(HoldKind::Actuator, robot.clock.now()); }));
  ASSERT_TRUE(tickUntil(
      robot, [&] { return !robot.authority.held(HoldKind::Actuator, robot.clock.now()); }));
}

TEST(OperatorLink, DeadClientIsAReleaseAndLosesTheLease) {
  const TempFolder folder;
  LinkedRobot robot(folder.endpoint());
  // A client that dies without a word: everything it sends from here on is lost.
  auto config = operatorConfig(folder.endpoint(), "anna");
  auto op = std::make_unique<LinkedOperator>(config);
  ASSERT_TRUE(takeControl(robot, *op));
  const std::uint64_t press = op->session->press();
  ASSERT_TRUE(tickUntil(robot, [&] {
    op->session->hold(JogBase{{0.3, 0.0, 0.0}}, press);
    return robot.authority.held(HoldKind::BaseJog, robot.clock.now());
  }));
  const auto epoch = robot.authority.epoch().value();
  // The socket's messages are no longer taken in: to the robot the client has died.
  ASSERT_TRUE(tickUntil(robot, [&] {
    static_cast<void>(robot.link->takeCommands());
    return !robot.authority.held(HoldKind::BaseJog, robot.clock.now());
  }));
  op.reset();
  ASSERT_TRUE(tickUntil(
      robot, [&] { return robot.authority.lease(robot.clock.now()).holder_client.empty(); }));
  EXPECT_GT(robot.authority.epoch().value(), epoch);
  EXPECT_THAT(robot.events.back(), HasSubstr("lost control"));
}

TEST(OperatorLink, ViewerMayLookButNotCommand) {
  const TempFolder folder;
  LinkedRobot robot(folder.endpoint());
  auto config = operatorConfig(folder.endpoint(), "guest");
  config.role = ClientRole::Viewer;
  LinkedOperator guest(config);
  ASSERT_TRUE(connected(robot, guest));
  const auto acquire = guest.session->send(AcquireLease{});
  ASSERT_TRUE(tickUntil(robot, [&] { return guest.fate(acquire).state == CommandState::Refused; }));
  EXPECT_EQ(guest.fate(acquire).code, "viewer");
  ASSERT_TRUE(tickUntil(robot, [&] { return guest.status().has_value(); }));
}

TEST(OperatorLink, RefusesAnotherMissionInWords) {
  const TempFolder folder;
  LinkedRobot robot(folder.endpoint());
  auto config = operatorConfig(folder.endpoint(), "anna");
  config.expected_mission_uuid = "mission-b";
  LinkedOperator op(config);
  ASSERT_TRUE(tickUntil(robot, [&] { return op.link().state == LinkState::Refused; }));
  EXPECT_THAT(op.link().reason, HasSubstr("mission-a"));
  EXPECT_THAT(op.link().reason, HasSubstr("mission-b"));
  const auto nonce = op.session->send(AcquireLease{});
  ASSERT_TRUE(tickUntil(robot, [&] { return op.fate(nonce).code == "no_link"; }));
}

TEST(OperatorLink, RefusesAnotherProtocolInWords) {
  const TempFolder folder;
  LinkedRobot robot(folder.endpoint());
  const auto addresses = parseEndpoint(folder.endpoint());
  ASSERT_TRUE(addresses.has_value());
  StationEnd::Options options;
  options.client_id = "future";
  auto end = StationEnd::connect(*addresses, options);
  ASSERT_TRUE(end.has_value());
  std::mutex mutex;
  std::string reason;
  Hello hello;
  hello.protocol = kProtocolVersion + 1;
  hello.version = "9.0.0";
  hello.client_id = "future";
  (*end)->start({[&](std::string_view bytes) {
                   const auto message = wire::decodeToStation(bytes);
                   const std::lock_guard lock(mutex);
                   if (message && std::holds_alternative<HelloReply>(*message)) {
                     reason = std::get<HelloReply>(*message).reason;
                   }
                 },
                 [](auto&&...) {}, [](auto&&...) {},
                 [&] { (*end)->send(wire::encode(ToRobot{hello})); }});
  ASSERT_TRUE(tickUntil(robot, [&] {
    const std::lock_guard lock(mutex);
    return !reason.empty();
  }));
  EXPECT_THAT(reason, HasSubstr("9.0.0"));
  EXPECT_THAT(reason, HasSubstr("install the same version"));
  end->reset();
}

TEST(OperatorLink, SecondDaemonOnTheSameAddressIsRefused) {
  const TempFolder folder;
  LinkedRobot robot(folder.endpoint());
  StopLatch stop;
  SteadyClock clock;
  OperatorLink::Config config;
  config.endpoint = folder.endpoint();
  const auto second = OperatorLink::open(config, {}, clock, stop);
  ASSERT_FALSE(second.has_value());
  EXPECT_EQ(second.error().code, ErrorCode::Unavailable);
  EXPECT_THAT(second.error().message, HasSubstr("in use"));
}

TEST(OperatorLink, RobotRestartEndsTheLeaseAndTheStationReconnects) {
  const TempFolder folder;
  auto robot = std::make_unique<LinkedRobot>(folder.endpoint());
  LinkedOperator op(operatorConfig(folder.endpoint(), "anna"));
  ASSERT_TRUE(takeControl(*robot, op));
  robot = nullptr;
  robot = std::make_unique<LinkedRobot>(folder.endpoint());
  ASSERT_TRUE(tickUntil(*robot, [&] { return !op.session->lease().mine; }));
  ASSERT_TRUE(connected(*robot, op));
  EXPECT_TRUE(takeControl(*robot, op));
}

}  // namespace
}  // namespace kiln::test
