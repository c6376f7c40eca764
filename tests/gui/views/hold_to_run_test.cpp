#include "tests/gui/views/station_fixture.h"

namespace kiln::gui {
namespace {

using testing::Test;

TEST_F(StationTest, EverythingMayBeHeldInTeleopWithLeaseAndAFreshView) {
  for (const HoldKind kind : {HoldKind::Base, HoldKind::Arm, HoldKind::Actuator, HoldKind::Macro})
    EXPECT_EQ(hold.lock(kind), QString());
}

TEST_F(StationTest, TheLockNamesItsReason) {
  status.mode = Mode::Autonomous;
  feed();
  EXPECT_TRUE(hold.lock(HoldKind::Base).contains("Teleop"));
  EXPECT_TRUE(hold.lock(HoldKind::Actuator).contains("Teleop"));
  EXPECT_TRUE(hold.lock(HoldKind::Macro).contains("Teleop"));
  status.mode = Mode::Teleop;
  status.lease.holder_client = "someone";
  status.lease.holder_name = "Grace";
  feed();
  EXPECT_TRUE(hold.lock(HoldKind::Base).contains("Grace"));
  status.lease = {};
  feed();
  EXPECT_TRUE(hold.lock(HoldKind::Base).contains("lease"));
}

TEST_F(StationTest, AHoldBelongsToOnePressAndEndsWhereTheRobotEndedIt) {
  ASSERT_TRUE(hold.hold(HoldKind::Base, JogBase{{0.3, 0, 0}}));
  hold.renew();
  ASSERT_EQ(link.presses.size(), 2u);
  EXPECT_EQ(link.presses[0], link.presses[1]) << "renewing is not pressing";
  CommandUpdate update;
  update.command = "jog_base";
  update.state = CommandState::Refused;
  update.code = "press_over";
  emit link.command(update);
  EXPECT_FALSE(hold.holding());
  ASSERT_TRUE(hold.hold(HoldKind::Base, JogBase{{0.3, 0, 0}}));
  EXPECT_GT(link.presses.back(), link.presses.front());
}

TEST_F(StationTest, AWindowThatWasBusyLetsGoInsteadOfHoldingNothing) {
  ASSERT_TRUE(hold.hold(HoldKind::Actuator, HoldActuator{"pumps", 1}));
  link.time.advanceBy(std::chrono::milliseconds(150));
  hold.renew();
  EXPECT_TRUE(hold.holding());
  link.time.advanceBy(std::chrono::milliseconds(250));  // the stream gives up after 200 ms
  hold.renew();
  EXPECT_FALSE(hold.holding());
}

TEST_F(StationTest, ASlowLinkRefusesJogsAndWarnsBefore) {
  EXPECT_EQ(hold.slowdown(), QString());
  health.rtt_s = 0.2;
  feed();
  EXPECT_EQ(hold.lock(HoldKind::Base), QString());
  EXPECT_TRUE(hold.slowdown().contains("half speed"));
  health.rtt_s = 0.64;
  feed();
  EXPECT_TRUE(hold.lock(HoldKind::Base).contains("640 ms"));
  EXPECT_EQ(hold.lock(HoldKind::Actuator), QString());  // spraying aims at nothing that moves
}

TEST_F(StationTest, JogNeedsACloudOrAPictureOfTheLastHalfSecond) {
  link.time.advanceBy(std::chrono::milliseconds(600));
  feed(false);
  EXPECT_TRUE(hold.lock(HoldKind::Arm).contains("no fresh view"));
  EXPECT_TRUE(hold.lock(HoldKind::Arm).contains("cloud 0.6 s"));
  auto image = std::make_shared<RgbImage>();
  image->stamp = link.time.now();
  image->frame = "operator_camera";
  emit link.image(image);  // without pixels: could not be decoded
  EXPECT_TRUE(hold.lock(HoldKind::Arm).contains("no fresh view"));
  image->width = image->height = 1;
  image->data = {1, 2, 3};
  emit link.image(image);
  EXPECT_EQ(hold.lock(HoldKind::Arm), QString());  // one fresh view is enough
}

TEST_F(StationTest, ReleasingOneOfTwoHoldsLeavesTheOtherRunning) {
  ASSERT_TRUE(hold.hold(HoldKind::Arm, JogArm{JogFrame::Base, Vector6d::Constant(0.1)}));
  ASSERT_TRUE(hold.hold(HoldKind::Actuator, HoldActuator{"pumps", 1}));
  hold.release(HoldKind::Arm);
  EXPECT_EQ(link.releases, 0);
  ASSERT_EQ(link.released.size(), 1u);
  EXPECT_TRUE(std::holds_alternative<JogArm>(link.released[0]));
  EXPECT_TRUE(hold.holding(HoldKind::Actuator));
  hold.release(HoldKind::Actuator);
  EXPECT_EQ(link.releases, 1);
  EXPECT_FALSE(hold.holding());
}

TEST_F(StationTest, RenewalRepeatsWhatIsHeld) {
  hold.hold(HoldKind::Base, JogBase{{0.5, 0, 0}});
  const std::size_t before = link.setpoints.size();
  hold.renew();
  ASSERT_EQ(link.setpoints.size(), before + 1);
  EXPECT_DOUBLE_EQ(lastSetpoint<JogBase>()->twist.vx_mps, 0.5);
}

TEST_F(StationTest, AMacroRestartsOnceAndNotWithEachRenewal) {
  hold.hold(HoldKind::Macro, HoldMacro{"arm park", true});
  EXPECT_TRUE(lastSetpoint<HoldMacro>()->restart);
  hold.renew();
  EXPECT_FALSE(lastSetpoint<HoldMacro>()->restart);
}

TEST_F(StationTest, ALockThatComesUpWhileHoldingLetsGoAndSaysWhy) {
  QString why;
  QObject::connect(&hold, &HoldToRun::tripped, [&](const QString& text) { why = text; });
  hold.hold(HoldKind::Base, JogBase{{0.5, 0, 0}});
  status.stop.latched = true;
  feed();
  hold.renew();
  EXPECT_FALSE(hold.holding());
  EXPECT_EQ(link.releases, 1);
  EXPECT_TRUE(why.contains("stop"));
  EXPECT_FALSE(hold.hold(HoldKind::Base, JogBase{{0.5, 0, 0}}));
}

TEST_F(StationTest, AViewThatFreezesWhileDrivingLetsGo) {
  hold.hold(HoldKind::Base, JogBase{{0.5, 0, 0}});
  link.time.advanceBy(std::chrono::milliseconds(501));
  feed(false);
  hold.renew();
  EXPECT_EQ(link.releases, 1);
}

}  // namespace
}  // namespace kiln::gui
