#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/system/two_ends.h"

namespace kiln::test {
namespace {

using ::testing::HasSubstr;

TEST(LinkFaults, ToleratesFivePercentLoss) {
  const TempFolder folder;
  LinkedRobot robot(folder.endpoint());
  auto config = operatorConfig(folder.endpoint(), "anna");
  config.up_loss = config.down_loss = 0.05;
  config.fault_seed = 7;
  LinkedOperator op(config);
  ASSERT_TRUE(takeControl(robot, op));
  // A hold goes on through single losses: the dead-man allows six periods.
  std::size_t gaps = 0;
  const std::uint64_t press = op.session->press();
  ASSERT_TRUE(tickUntil(robot, [&] {
    op.session->hold(JogBase{{0.3, 0.0, 0.0}}, press);
    gaps = robot.released.size();
    return robot.accepted.size() >= 50;
  }));
  EXPECT_EQ(gaps, 0u);
  std::uint64_t lost = 0;
  ASSERT_TRUE(tickUntil(robot, [&] {
    lost = 0;
    for (const DropCount& drop : op.link().drops) lost += drop.dropped;
    return lost > 0;
  }));
}

TEST(LinkFaults, DeafRobotIsNamedAtTheStation) {
  const TempFolder folder;
  LinkedRobot robot(folder.endpoint());
  auto config = operatorConfig(folder.endpoint(), "anna");
  config.up_delay_s = 2.5;  // the up-link stalls: hello gets through late, then nothing in time
  LinkedOperator op(config);
  ASSERT_TRUE(tickUntil(robot, [&] { return op.link().state == LinkState::Lost; }));
  EXPECT_THAT(op.link().reason, HasSubstr("does not hear us"));
  const auto nonce = op.session->send(AcquireLease{});
  ASSERT_TRUE(tickUntil(robot, [&] { return op.fate(nonce).state == CommandState::Refused; }));
  EXPECT_EQ(op.fate(nonce).code, "no_link");
}

TEST(LinkFaults, SlowLinkRefusesJogs) {
  const TempFolder folder;
  LinkedRobot robot(folder.endpoint());
  auto config = operatorConfig(folder.endpoint(), "anna");
  config.up_delay_s = 0.6;
  LinkedOperator op(config);
  const std::uint64_t press = op.session->press();
  op.session->hold(JogBase{}, press);
  ASSERT_TRUE(tickUntil(robot, [&] { return op.link().rtt_s > 0.5; }));
  ASSERT_TRUE(tickUntil(robot, [&] {
    if (!op.session->lease().mine) op.session->send(AcquireLease{});
    return op.session->lease().mine;
  }));
  const std::uint64_t again = op.session->press();
  ASSERT_TRUE(tickUntil(robot, [&] {
    op.session->hold(JogBase{{0.3, 0.0, 0.0}}, again);
    for (const CommandUpdate& update : op.updates()) {
      if (update.command == "jog_base" && update.state == CommandState::Refused) return true;
    }
    return false;
  }));
  for (const auto& a : robot.accepted)
    EXPECT_FALSE(std::holds_alternative<JogBase>(a.command.body));
}

TEST(LinkFaults, UnansweredCommandBecomesUnknownAndIsNotSentAgain) {
  const TempFolder folder;
  LinkedRobot robot(folder.endpoint());
  auto config = operatorConfig(folder.endpoint(), "anna");
  config.ack_timeout_s = 0.3;
  LinkedOperator op(config);
  ASSERT_TRUE(takeControl(robot, op));
  std::size_t arrived = 0;
  const auto nonce = op.session->send(SetMode{Mode::Supervised});
  // A robot that takes commands in and never answers.
  for (Stamp start = robot.clock.now(); op.fate(nonce).state != CommandState::Unknown;) {
    arrived += robot.link->takeCommands().size();
    ASSERT_LT(toSeconds(robot.clock.now() - start), 20.0);
  }
  EXPECT_EQ(arrived, 1u);
}

}  // namespace
}  // namespace kiln::test
