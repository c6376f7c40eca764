// What comes from outside: names, stamps and pictures that claim what cannot be.
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/core/text.h"
#include "common/wire/command.h"
#include "common/wire/fsm.h"
#include "common/wire/sensor.h"
#include "common/wire/telemetry.h"
#include "kiln/v1/command.pb.h"

namespace kiln::wire {
namespace {

using ::testing::HasSubstr;

const std::string kHostile = "x\n12:00 info safety: STOP cleared\x1b[2J\u202e\u200b";
const std::string kClean = "x 12:00 info safety: STOP cleared?[2J??";

/// The protocol's own encoder cleans nothing: a hostile client has another.
template <class Body>
Result<ToRobot> decoded(Body body) {
  v1::ToRobot message;
  body(message);
  return decodeToRobot(message.SerializeAsString());
}

TEST(OutsideText, HelloAndCommandNamesAreCleanAndShort) {
  const auto hello = decoded([](v1::ToRobot& m) {
    m.mutable_hello()->set_protocol(kProtocolVersion);
    m.mutable_hello()->set_client_id(kHostile);
    m.mutable_hello()->set_operator_name(std::string(60'000, 'x'));
    m.mutable_hello()->set_version(kHostile);
  });
  ASSERT_TRUE(hello.has_value()) << hello.error();
  EXPECT_EQ(std::get<Hello>(*hello).client_id, kClean);
  EXPECT_EQ(std::get<Hello>(*hello).version, kClean);
  EXPECT_EQ(std::get<Hello>(*hello).operator_name, std::string(63, 'x') + "…");
}

TEST(OutsideText, EveryWordOfACommandIsCleaned) {
  const auto nameOf = [](auto set, auto get) {
    const auto command = decoded([&](v1::ToRobot& m) { set(*m.mutable_command()); });
    EXPECT_TRUE(command.has_value());
    return get(std::get<Command>(*command).body);
  };
  EXPECT_EQ(nameOf([](v1::Command& m) { m.set_acknowledge_alarm(kHostile); },
                   [](auto& b) { return std::get<AcknowledgeAlarm>(b).id; }),
            kClean);
  EXPECT_EQ(nameOf([](v1::Command& m) { m.mutable_hold_macro()->set_name(kHostile); },
                   [](auto& b) { return std::get<HoldMacro>(b).name; }),
            kClean);
  EXPECT_EQ(nameOf([](v1::Command& m) { m.mutable_change_state()->set_to(kHostile); },
                   [](auto& b) { return std::get<ChangeState>(b).to; }),
            kClean);
  EXPECT_EQ(nameOf([](v1::Command& m) { m.mutable_mission_command()->set_name(kHostile); },
                   [](auto& b) { return std::get<MissionCommand>(b).name; }),
            kClean);
  EXPECT_EQ(nameOf([](v1::Command& m) { m.mutable_mission_command()->set_target(kHostile); },
                   [](auto& b) { return std::get<MissionCommand>(b).target; }),
            kClean);
  EXPECT_EQ(
      nameOf(
          [](v1::Command& m) { m.mutable_mission_command()->add_arguments()->set_name(kHostile); },
          [](auto& b) { return std::get<MissionCommand>(b).arguments.at(0).name; }),
      kClean);
  EXPECT_EQ(nameOf([](v1::Command& m) { m.mutable_hold_actuator()->set_name(kHostile); },
                   [](auto& b) { return std::get<HoldActuator>(b).name; }),
            kClean);
}

TEST(OutsideText, AStopIsReadWhateverItsSenderCallsHimself) {
  for (const std::string& name : {kHostile, std::string(70'000, 'x'), std::string()}) {
    const auto stop = decodeStopRequest(encode(StopRequest{"c", name, 7, 0}));
    ASSERT_TRUE(stop.has_value()) << stop.error();
    EXPECT_EQ(stop->nonce, 7u);
    EXPECT_EQ(stop->operator_name, printableName(name));
  }
}

TEST(OutsideText, WhatTheRobotSaysIsCleanedAtTheStationToo) {
  RobotStatus status;
  status.reason = kHostile;
  status.stop.source = kHostile;
  status.operators = {kHostile};
  status.alarms.push_back({"id", AlarmLevel::Warning, kHostile, kHostile, {}, true, false});
  const auto back = decodeRobotStatus(encode(status));
  ASSERT_TRUE(back.has_value()) << back.error();
  EXPECT_EQ(back->reason, kClean);
  EXPECT_EQ(back->stop.source, kClean);
  EXPECT_EQ(back->operators.at(0), kClean);
  EXPECT_EQ(back->alarms.at(0).action, kClean);
  const auto log = decodeLogBatch(encode(LogBatch{{{{}, 2, kHostile, kHostile}}, 0}));
  ASSERT_TRUE(log.has_value());
  EXPECT_EQ(log->lines.at(0).text, kClean);
  EXPECT_EQ(log->lines.at(0).logger, kClean);
}

TEST(OutsideStamp, HostileStampsAndDurationsAreRefused) {
  const auto heartbeat = [](auto set) {
    return decoded([&](v1::ToRobot& m) { set(*m.mutable_heartbeat()); }).has_value();
  };
  EXPECT_TRUE(heartbeat([](v1::Heartbeat& m) { m.set_rtt_s(0.5); }));
  for (const std::int64_t ns : {std::numeric_limits<std::int64_t>::min(),
                                std::numeric_limits<std::int64_t>::max(), std::int64_t{1} << 62}) {
    EXPECT_FALSE(heartbeat([&](v1::Heartbeat& m) { m.set_robot_estimate_ns(ns); })) << ns;
    EXPECT_FALSE(heartbeat([&](v1::Heartbeat& m) { m.set_station_send_ns(ns); })) << ns;
    EXPECT_FALSE(decoded([&](v1::ToRobot& m) {
                   m.mutable_command()->set_issued_robot_ns(ns);
                   m.mutable_command()->mutable_pause();
                 }).has_value())
        << ns;
  }
  for (const double s : {std::nan(""), -1.0, 1e300, std::numeric_limits<double>::infinity()}) {
    EXPECT_FALSE(heartbeat([&](v1::Heartbeat& m) { m.set_rtt_s(s); })) << s;
    EXPECT_FALSE(heartbeat([&](v1::Heartbeat& m) { m.set_rx_age_s(s); })) << s;
  }
}

/// A frame header and nothing else.
std::vector<std::uint8_t> jpegOf(int width, int height) {
  const auto high = [](int v) { return static_cast<std::uint8_t>(v >> 8); };
  const auto low = [](int v) { return static_cast<std::uint8_t>(v & 0xFF); };
  return {0xFF,        0xD8,        0xFF,       0xC0, 0, 17,   8, high(height),
          low(height), high(width), low(width), 3,    1, 0x11, 0, 2,
          0x11,        0,           3,          0x11, 0};
}

TEST(OutsidePicture, AJpegThatIsNotOfTheSizeThatItsMessageSaysIsRefused) {
  EXPECT_TRUE(decodeJpeg(encode(JpegImage{{}, 1, "rgb", 64, 48, jpegOf(64, 48)})).has_value());
  const auto bomb = decodeJpeg(encode(JpegImage{{}, 1, "rgb", 64, 48, jpegOf(30'000, 30'000)}));
  ASSERT_FALSE(bomb.has_value());
  EXPECT_THAT(bomb.error().message, HasSubstr("30000 x 30000"));
  EXPECT_FALSE(decodeJpeg(encode(JpegImage{{}, 1, "rgb", 64, 48, {1, 2, 3}})).has_value());
}

}  // namespace
}  // namespace kiln::wire
