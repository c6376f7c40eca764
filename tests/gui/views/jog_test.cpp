#include "gui/views/teleop/jog_keys.h"
#include "gui/views/teleop/jog_mixer.h"
#include "gui/views/teleop/jog_pad.h"
#include "tests/gui/views/station_fixture.h"

namespace kiln::gui {
namespace {

TEST(StickValue, IsZeroInTheDeadZoneAndGrowsFromZeroAtItsEdge) {
  EXPECT_EQ(stickValue({0, 0}, 50, 0.1), QPointF(0, 0));
  EXPECT_EQ(stickValue({4, -3}, 50, 0.1), QPointF(0, 0));      // 5 px of 50: on the edge
  const QPointF just_outside = stickValue({5.5, 0}, 50, 0.1);  // 0.11 -> (0.11 - 0.1) / 0.9
  EXPECT_NEAR(just_outside.x(), 0.01 / 0.9, 1e-12);
}

TEST(StickValue, PointsUpForUpAndIsClampedToTheUnitCircle) {
  const QPointF up = stickValue({0, -50}, 50, 0.1);
  EXPECT_NEAR(up.x(), 0.0, 1e-12);
  EXPECT_NEAR(up.y(), 1.0, 1e-12);
  const QPointF far = stickValue({3000, 4000}, 50, 0.1);
  EXPECT_NEAR(far.x(), 0.6, 1e-12);
  EXPECT_NEAR(far.y(), -0.8, 1e-12);
}

TEST(StickValue, RefusesWhatIsNoPlace) {
  EXPECT_EQ(stickValue({NAN, 1}, 50, 0.1), QPointF());
  EXPECT_EQ(stickValue({10, 10}, 0, 0.1), QPointF());
}

TEST(JogKeys, IgnoreAutoRepeatAndLetOppositeKeysCancel) {
  JogKeys keys;
  EXPECT_TRUE(keys.press(Qt::Key_W, false));
  EXPECT_TRUE(keys.release(Qt::Key_W, true));  // X11 reports auto-repeat as release and press
  EXPECT_TRUE(keys.press(Qt::Key_W, true));
  EXPECT_EQ(keys.base(), Eigen::Vector3d(1, 0, 0));
  keys.press(Qt::Key_S, false);
  EXPECT_EQ(keys.base(), Eigen::Vector3d(0, 0, 0));
  keys.release(Qt::Key_W, false);
  keys.release(Qt::Key_S, false);
  EXPECT_FALSE(keys.any());
  EXPECT_FALSE(keys.press(Qt::Key_X, false));
}

TEST(JogKeys, ShiftTurnsTheToolInsteadOfMovingIt) {
  JogKeys keys;
  keys.press(Qt::Key_Left, false);
  EXPECT_EQ(keys.armMove(), Eigen::Vector3d(0, 1, 0));
  keys.setShift(true);
  EXPECT_EQ(keys.armMove(), Eigen::Vector3d(0, 0, 0));
  EXPECT_EQ(keys.armTurn(), Eigen::Vector3d(0, 0, 1));  // to the left, about up
}

TEST(JogMixer, FullStickIsTheFullSpeedAndADiagonalIsNoFaster) {
  JogMixer mixer;
  JogKeys keys;
  mixer.drive = {0, 1};
  EXPECT_DOUBLE_EQ(mixer.base(keys).twist.vx_mps, 1.0);
  EXPECT_DOUBLE_EQ(mixer.base(keys).twist.vy_mps, 0.0);
  keys.press(Qt::Key_A, false);  // and left by key
  const Twist2 both = mixer.base(keys).twist;
  EXPECT_NEAR(std::hypot(both.vx_mps, both.vy_mps), 1.0, 1e-12);
  EXPECT_GT(both.vy_mps, 0.0);
  mixer.turn = 1.0;  // bar to the right: clockwise
  EXPECT_DOUBLE_EQ(mixer.base(keys).twist.wz_radps, -0.6);
}

TEST(JogMixer, AJointJogMovesOneJointOnly) {
  JogMixer mixer;
  mixer.arm_mode = ArmJogMode::Joint;
  mixer.joint = 3;
  mixer.arm = {0.5, 0.0};
  const JogArm jog = mixer.armSetpoint({});
  EXPECT_EQ(jog.frame, JogFrame::Joint);
  EXPECT_NEAR(jog.velocity[3], 0.3, 1e-12);
  EXPECT_NEAR(jog.velocity.norm(), 0.3, 1e-12);
}

TEST_F(StationTest, JogPadFollowsTheMouseAndSpringsBack) {
  JogPad pad(ui, JogPad::Axes::Both);
  pad.resize(pad.sizeHint());
  std::vector<QPointF> values;
  QObject::connect(&pad, &JogPad::moved, [&](const QPointF& v) { values.push_back(v); });
  const QPointF middle(pad.width() / 2.0, pad.height() / 2.0);
  mouse(pad, QEvent::MouseButtonPress, middle);
  mouse(pad, QEvent::MouseMove, middle + QPointF(0, -400));
  EXPECT_NEAR(pad.value().y(), 1.0, 1e-12);
  mouse(pad, QEvent::MouseButtonRelease, middle + QPointF(0, -400));
  EXPECT_EQ(pad.value(), QPointF());
  ASSERT_FALSE(values.empty());
  EXPECT_EQ(values.back(), QPointF());
}

TEST_F(StationTest, AVerticalPadHasNoSidewaysAxis) {
  JogPad pad(ui, JogPad::Axes::Vertical);
  pad.resize(pad.sizeHint());
  mouse(pad, QEvent::MouseButtonPress, {400.0, 0.0});
  EXPECT_EQ(pad.value().x(), 0.0);
  EXPECT_GT(pad.value().y(), 0.5);
}

}  // namespace
}  // namespace kiln::gui
