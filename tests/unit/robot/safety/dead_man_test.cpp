#include "robot/safety/dead_man.h"

#include <functional>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace kiln {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

Stamp at(double s) { return Stamp{fromSeconds(s)}; }

Command from(CommandBody body, std::uint64_t press = 1) {
  Command command;
  command.client_id = "anna";
  command.press = press;
  command.body = std::move(body);
  return command;
}

TEST(DeadMan, HoldsFor250MsAfterTheLastSetpoint) {
  DeadMan dead_man({});
  dead_man.feed(from(JogBase{{0.1, 0, 0}}), at(1.0));
  EXPECT_TRUE(dead_man.held(HoldKind::BaseJog, at(1.25)));
  EXPECT_FALSE(dead_man.held(HoldKind::BaseJog, at(1.26)));
  EXPECT_FALSE(dead_man.held(HoldKind::Actuator, at(1.0)));
}

TEST(DeadMan, ReportsEachReleaseEdgeOnce) {
  DeadMan dead_man({});
  dead_man.feed(from(JogBase{{0.1, 0, 0}}), at(1.0));
  dead_man.feed(from(HoldActuator{"pumps", 1}), at(1.2));
  EXPECT_THAT(dead_man.takeReleased(at(1.2)), IsEmpty());
  EXPECT_THAT(dead_man.takeReleased(at(1.3)), ElementsAre(HoldKind::BaseJog));
  EXPECT_THAT(dead_man.takeReleased(at(1.4)), IsEmpty());
  EXPECT_THAT(dead_man.takeReleased(at(1.5)), ElementsAre(HoldKind::Actuator));
}

TEST(DeadMan, ExplicitZeroIsAReleaseAtOnce) {
  DeadMan dead_man({});
  JogArm arm;
  arm.velocity[2] = 0.1;
  dead_man.feed(from(arm), at(1.0));
  dead_man.feed(from(HoldMacro{"m", false}), at(1.0));
  dead_man.feed(from(JogArm{}, 0), at(1.02));
  EXPECT_FALSE(dead_man.held(HoldKind::ArmJog, at(1.02)));
  EXPECT_TRUE(dead_man.held(HoldKind::Macro, at(1.02)));
  dead_man.feed(from(ReleaseAll{}, 0), at(1.04));
  EXPECT_FALSE(dead_man.anyHeld(at(1.04)));
  EXPECT_THAT(dead_man.takeReleased(at(1.04)), ElementsAre(HoldKind::ArmJog, HoldKind::Macro));
}

TEST(DeadMan, APressThatTimedOutIsOver) {
  DeadMan dead_man({});
  const JogBase forward{{0.1, 0, 0}};
  dead_man.feed(from(forward, 3), at(1.0));
  dead_man.expire(at(1.4));  // the link stalled
  EXPECT_FALSE(dead_man.mayFeed(from(forward, 3)));
  EXPECT_FALSE(dead_man.mayFeed(from(forward, 2))) << "and every one before it";
  EXPECT_TRUE(dead_man.mayFeed(from(forward, 4)));
  EXPECT_TRUE(dead_man.mayFeed(from(HoldActuator{"pumps", 1}, 3))) << "of this kind alone";
  EXPECT_TRUE(dead_man.mayFeed(from(ReleaseAll{}, 0)));
}

TEST(DeadMan, EveryEndOfAHoldEndsItsPress) {
  const JogBase forward{{0.1, 0, 0}};
  const std::vector<std::function<void(DeadMan&)>> ends = {
      [](DeadMan& d) { d.releaseAll(); },
      [](DeadMan& d) { d.end(HoldKind::BaseJog); },
      [](DeadMan& d) { d.feed(from(ReleaseAll{}, 0), at(1.1)); },
      [](DeadMan& d) { d.feed(from(JogBase{}, 0), at(1.1)); },
      [&](DeadMan& d) { d.refused(from(forward, 3), false); },
      [&](DeadMan& d) { d.feed(from(forward, 4), at(1.1)); },
  };
  for (const auto& end : ends) {
    DeadMan dead_man({});
    dead_man.feed(from(forward, 3), at(1.0));
    end(dead_man);
    EXPECT_FALSE(dead_man.mayFeed(from(forward, 3)));
  }
}

TEST(DeadMan, ARefusedStartIsOverButALateMessageOfAHoldIsNot) {
  DeadMan dead_man({});
  const JogBase forward{{0.1, 0, 0}};
  dead_man.refused(from(forward, 3), true);  // late, and nothing held
  EXPECT_FALSE(dead_man.mayFeed(from(forward, 3)));
  dead_man.feed(from(forward, 4), at(1.0));
  dead_man.refused(from(forward, 4), true);
  EXPECT_TRUE(dead_man.mayFeed(from(forward, 4)));
}

TEST(DeadMan, AZeroWithinAPressKeepsIt) {
  DeadMan dead_man({});
  dead_man.feed(from(JogBase{{0.1, 0, 0}}, 3), at(1.0));
  dead_man.feed(from(JogBase{}, 3), at(1.2));  // the stick passes its middle
  EXPECT_TRUE(dead_man.held(HoldKind::BaseJog, at(1.4)));
}

TEST(DeadMan, NobodyHoldsWithoutAPress) {
  DeadMan dead_man({});
  EXPECT_FALSE(dead_man.mayFeed(from(JogBase{{0.1, 0, 0}}, 0)));
}

TEST(DeadMan, ZerosAloneAreNoHold) {
  DeadMan dead_man({});
  dead_man.feed(from(JogBase{}, 0), at(1.0));
  EXPECT_FALSE(dead_man.anyHeld(at(1.0)));
  EXPECT_THAT(dead_man.takeReleased(at(2.0)), IsEmpty());
}

}  // namespace
}  // namespace kiln
