#include "common/client/link_talk.h"

#include <gtest/gtest.h>

namespace kiln {
namespace {

/// The station's end in 20 ms steps; the robot's clock is 5 s ahead, each way takes 10 ms.
class LinkTalkTest : public testing::Test {
 protected:
  static constexpr std::int64_t kAhead_ns = 5'000'000'000, kWay_ns = 10'000'000;

  std::optional<ToRobot> step() {
    now += std::chrono::milliseconds(20);
    clock_ns += 20'000'000;
    auto word = talk.due(now, clock_ns);
    if (word && std::holds_alternative<Heartbeat>(*word)) ++heartbeats;
    return word;
  }
  void answer(Heartbeat heartbeat) {
    heartbeat.robot_receive_ns = heartbeat.station_send_ns + kAhead_ns + kWay_ns;
    heartbeat.robot_send_ns = heartbeat.robot_receive_ns;
    talk.heard(10, now);
    talk.onHeartbeat(heartbeat, heartbeat.station_send_ns + 2 * kWay_ns, now);
  }

  static HelloReply reply(bool accepted, const std::string& reason = "") {
    HelloReply out;
    out.accepted = accepted;
    out.reason = reason;
    return out;
  }

  Monotonic::time_point now{std::chrono::seconds(100)};
  std::int64_t clock_ns = 1'000'000'000;
  int heartbeats = 0;
  LinkTalk talk{{kProtocolVersion, "1.0", "me", "somebody", ClientRole::Operator, ""}, 0.5, 1.5};
};

TEST_F(LinkTalkTest, SaysHelloTenTimesASecondUntilItIsAccepted) {
  int hellos = 0;
  for (int i = 0; i < 50; ++i) hellos += step().has_value() ? 1 : 0;
  EXPECT_EQ(hellos, 10);
  EXPECT_EQ(heartbeats, 0);
  talk.onHelloReply(reply(true));
  for (int i = 0; i < 50; ++i) (void)step();
  // Eight at 40 ms, then one every 200 ms of the remaining 0.7 s.
  EXPECT_NEAR(heartbeats, 8 + 3, 1);
}

TEST_F(LinkTalkTest, NoCommandBeforeTheClockOffsetIsKnownAndNoneAfterSilence) {
  talk.onHelloReply(reply(true));
  talk.heard(10, now);
  EXPECT_FALSE(talk.commandTime(now, clock_ns).has_value());
  for (int i = 0; i < 20; ++i) {
    const auto word = step();
    if (word) answer(std::get<Heartbeat>(*word));
  }
  const auto issued = talk.commandTime(now, clock_ns);
  ASSERT_TRUE(issued.has_value());
  EXPECT_NEAR(static_cast<double>(*issued - clock_ns), static_cast<double>(kAhead_ns), 1e6);
  for (int i = 0; i < 100; ++i) (void)step();
  EXPECT_FALSE(talk.commandTime(now, clock_ns).has_value()) << "nothing heard for 2 s";
}

TEST_F(LinkTalkTest, ARefusalForgetsTheClockAndSaysHelloAgain) {
  talk.onHelloReply(reply(true));
  for (int i = 0; i < 20; ++i) {
    if (const auto word = step()) answer(std::get<Heartbeat>(*word));
  }
  ASSERT_TRUE(talk.report(now, 0).clock_known);
  talk.onHelloReply(reply(false, "another mission"));
  EXPECT_FALSE(talk.report(now, 0).clock_known);
  EXPECT_EQ(talk.report(now, 0).reason.empty(), false);
  bool hello = false;
  for (int i = 0; i < 10; ++i) {
    const auto word = step();
    hello = hello || (word && std::holds_alternative<Hello>(*word));
  }
  EXPECT_TRUE(hello);
}

TEST_F(LinkTalkTest, CountsWhatWasLostByTopicAndWhatTheRobotDropped) {
  const Topic topic = topicTable().front().topic;
  talk.onFrame(topic, 2, 5);
  talk.onFrame(topic, 1, 6);  // the robot's own count is a total, ours are differences
  const LinkReport report = talk.report(now, 4);
  EXPECT_EQ(report.drops.front().dropped, 3U + 6U);
  EXPECT_EQ(report.drops.back().dropped, 4U);
}

}  // namespace
}  // namespace kiln
