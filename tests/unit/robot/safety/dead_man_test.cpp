#include "robot/safety/dead_man.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace kiln {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

Stamp at(double s) { return Stamp{fromSeconds(s)}; }

TEST(DeadMan, HoldsFor250MsAfterTheLastSetpoint) {
  DeadMan dead_man({});
  dead_man.feed(JogBase{{0.1, 0, 0}}, at(1.0));
  EXPECT_TRUE(dead_man.held(HoldKind::BaseJog, at(1.25)));
  EXPECT_FALSE(dead_man.held(HoldKind::BaseJog, at(1.26)));
  EXPECT_FALSE(dead_man.held(HoldKind::Pump, at(1.0)));
}

TEST(DeadMan, ReportsEachReleaseEdgeOnce) {
  DeadMan dead_man({});
  dead_man.feed(JogBase{{0.1, 0, 0}}, at(1.0));
  dead_man.feed(HoldPump{1, 1}, at(1.2));
  EXPECT_THAT(dead_man.takeReleased(at(1.2)), IsEmpty());
  EXPECT_THAT(dead_man.takeReleased(at(1.3)), ElementsAre(HoldKind::BaseJog));
  EXPECT_THAT(dead_man.takeReleased(at(1.4)), IsEmpty());
  EXPECT_THAT(dead_man.takeReleased(at(1.5)), ElementsAre(HoldKind::Pump));
}

TEST(DeadMan, ExplicitZeroIsAReleaseAtOnce) {
  DeadMan dead_man({});
  JogArm arm;
  arm.velocity[2] = 0.1;
  dead_man.feed(arm, at(1.0));
  dead_man.feed(HoldMacro{"m", false}, at(1.0));
  dead_man.feed(JogArm{}, at(1.02));
  EXPECT_FALSE(dead_man.held(HoldKind::ArmJog, at(1.02)));
  EXPECT_TRUE(dead_man.held(HoldKind::Macro, at(1.02)));
  dead_man.feed(ReleaseAll{}, at(1.04));
  EXPECT_FALSE(dead_man.anyHeld(at(1.04)));
  EXPECT_THAT(dead_man.takeReleased(at(1.04)), ElementsAre(HoldKind::ArmJog, HoldKind::Macro));
}

TEST(DeadMan, ZerosAloneAreNoHold) {
  DeadMan dead_man({});
  dead_man.feed(JogBase{}, at(1.0));
  EXPECT_FALSE(dead_man.anyHeld(at(1.0)));
  EXPECT_THAT(dead_man.takeReleased(at(2.0)), IsEmpty());
}

}  // namespace
}  // namespace kiln
