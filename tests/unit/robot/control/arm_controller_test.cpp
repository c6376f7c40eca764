#include "robot/control/arm_controller.h"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/support/fake_devices.h"

namespace kiln {
namespace {

using std::chrono::milliseconds;
using Kind = ArmSetpoint::Kind;
constexpr Duration kTick = milliseconds(8);

Vector6d start() {
  Vector6d q;
  q << 0.1, -1.5, 1.8, -0.3, 1.5, 0.2;
  return q;
}

class ArmControllerTest : public ::testing::Test {
 protected:
  void SetUp() override { idle(0.05); }
  void tick() {
    clock.advanceBy(kTick);
    arm.advance();
    controller.tick(clock.now());
  }
  void idle(double seconds) {
    const Stamp end = clock.now() + fromSeconds(seconds);
    while (clock.now() < end) tick();
  }
  void jog(const Vector6d& qd, double seconds) {
    const Stamp end = clock.now() + fromSeconds(seconds);
    for (int k = 0; clock.now() < end; ++k) {
      if (k % 3 == 0) {
        controller.setpoint({.kind = Kind::JointVelocity, .stamp = clock.now(), .qd = qd});
      }
      tick();
    }
  }
  /// Streams q0 + A (1 - cos(w t)) on joint 1 at 50 Hz (every 2.5th tick).
  void stream(double amplitude, double omega, double seconds, double stop_force_n = 0.0) {
    const Vector6d q0 = controller.tracking().q_command;
    const Stamp begin = clock.now();
    Stamp next = begin;
    while (clock.now() < begin + fromSeconds(seconds)) {
      if (clock.now() >= next) {
        const double t = toSeconds(clock.now() - begin);
        ArmSetpoint sp{
            .kind = Kind::Joints, .stamp = clock.now(), .q = q0, .stop_force_n = stop_force_n};
        sp.q[0] += amplitude * (1 - std::cos(omega * t));
        sp.qd[0] = amplitude * omega * std::sin(omega * t);
        wanted = sp.q[0];
        controller.setpoint(sp);
        next += milliseconds(20);
      }
      tick();
      worst_lag = std::max(worst_lag, std::abs(controller.tracking().q_command[0] - wanted));
    }
  }
  /// Largest speed, acceleration and jerk of what reached the device, from `from` on.
  Eigen::Vector3d derivatives(std::size_t from) const {
    const auto sent = arm.sent();
    Eigen::Vector3d worst = Eigen::Vector3d::Zero();
    const double dt = toSeconds(kTick);
    for (std::size_t k = from + 3; k < sent.size(); ++k) {
      const Vector6d v1 = (sent[k].q - sent[k - 1].q) / dt;
      const Vector6d v0 = (sent[k - 1].q - sent[k - 2].q) / dt;
      const Vector6d vp = (sent[k - 2].q - sent[k - 3].q) / dt;
      worst[0] = std::max(worst[0], v1.cwiseAbs().maxCoeff());
      worst[1] = std::max(worst[1], ((v1 - v0) / dt).cwiseAbs().maxCoeff());
      worst[2] = std::max(worst[2], ((v1 - 2 * v0 + vp) / (dt * dt)).cwiseAbs().maxCoeff());
    }
    return worst;
  }

  ManualClock clock{Stamp{std::chrono::seconds(10)}};
  RobotGeometry robot;
  FakeArm arm{clock, robot, start()};
  StopLatch stop;
  ArmController controller{{}, robot, arm, stop};
  double wanted = 0.0, worst_lag = 0.0;
};

TEST_F(ArmControllerTest, TracksA50HzStreamSmoothly) {
  const std::size_t from = arm.sent().size();
  stream(0.4, 1.5, 4.0);  // peaks: 0.6 rad/s, 0.9 rad/s2, starts with an acceleration step
  EXPECT_LT(worst_lag, 0.02);
  const Eigen::Vector3d worst = derivatives(from);
  EXPECT_LE(worst[0], 0.7);
  EXPECT_LE(worst[1], 4.0 + 1e-6);
  EXPECT_LE(worst[2], 40.0 + 1e-6);
  EXPECT_TRUE(controller.tracking().blocked.empty()) << controller.tracking().blocked;
}

TEST_F(ArmControllerTest, JogKeepsItsLimitsAndStopsBeforeTheEndOfTheJoint) {
  Vector6d qd = Vector6d::Zero();
  qd[2] = 10.0;  // elbow, limit 180 deg, wish far above 90 deg/s
  const std::size_t from = arm.sent().size();
  jog(qd, 4.0);
  EXPECT_LE(derivatives(from)[0], M_PI / 2 + 1e-6);
  EXPECT_LE(derivatives(from)[1], 4.0 + 1e-6);
  EXPECT_LT(controller.tracking().q_command[2], M_PI);
  EXPECT_GT(controller.tracking().q_command[2], M_PI - 6 * M_PI / 180);
}

TEST_F(ArmControllerTest, StopsAStaleJogSmoothly) {
  Vector6d qd = Vector6d::Zero();
  qd[0] = 0.5;
  jog(qd, 1.0);
  idle(0.6);
  EXPECT_TRUE(controller.tracking().at_rest);
  EXPECT_NE(controller.tracking().blocked.find("old"), std::string::npos);
  EXPECT_LE(derivatives(0)[1], 8.0 + 1e-6);
}

TEST_F(ArmControllerTest, RefusesBadSetpointsBeforeTheyReachTheDevice) {
  const Vector6d q0 = controller.tracking().q_command;
  struct Case {
    const char* what;
    ArmSetpoint setpoint;
  };
  ArmSetpoint nan{.kind = Kind::Joints, .stamp = {}, .q = q0};
  nan.q[3] = NAN;
  ArmSetpoint limits{.kind = Kind::Joints, .stamp = {}, .q = q0};
  limits.q[2] = 3.3;
  ArmSetpoint jump{.kind = Kind::Joints, .stamp = {}, .q = q0};
  jump.q[0] += 0.5;
  ArmSetpoint speed{.kind = Kind::Joints, .stamp = {}, .q = q0};
  speed.qd[0] = 3.0;
  const std::vector<Case> cases{
      {"not a number", nan}, {"outside", limits}, {"jumps", jump}, {"above", speed}};
  for (const Case& c : cases) {
    ArmSetpoint sp = c.setpoint;
    sp.stamp = clock.now();
    controller.setpoint(sp);
    tick();
    EXPECT_TRUE(controller.tracking().refused) << c.what;
    EXPECT_NE(controller.tracking().blocked.find(c.what), std::string::npos)
        << controller.tracking().blocked;
    idle(0.3);
  }
  for (const ArmServo& servo : arm.sent()) ASSERT_LT((servo.q - q0).norm(), 1e-9);
}

TEST_F(ArmControllerTest, StopLatchDeceleratesFastAndVoidsWhatCameBefore) {
  Vector6d qd = Vector6d::Zero();
  qd[0] = 0.8;
  jog(qd, 1.0);
  stop.set("supervisor", clock.now());
  const Stamp at = clock.now();
  while (!controller.tracking().at_rest) tick();
  EXPECT_LE(toSeconds(clock.now() - at), 0.3);  // 0.8 / 8 + 0.05 s + the servo's lag
  const Vector6d rest = controller.tracking().q_command;
  controller.setpoint({.kind = Kind::JointVelocity, .stamp = clock.now(), .qd = qd});
  tick();
  ASSERT_TRUE(stop.clear(stop.generation()));
  idle(0.5);
  EXPECT_LT((controller.tracking().q_command - rest).norm(), 1e-9);
}

TEST_F(ArmControllerTest, ProtectiveStopEndsOnlyByTheWordAndThenNothingMovesByItself) {
  stream(0.3, 1.0, 1.0);
  arm.setSafety(ArmSafetyMode::ProtectiveStop);
  Vector6d pushed = arm.state()->q;
  pushed[1] += 0.2;
  arm.setQ(pushed);
  const std::size_t sent_before = arm.sent().size() + 1;
  stream(0.3, 1.0, 0.5);
  EXPECT_TRUE(controller.tracking().protective_stop);
  EXPECT_FALSE(controller.tracking().ready);
  EXPECT_LE(arm.sent().size(), sent_before);
  EXPECT_EQ(arm.releases(), 0);

  arm.setSafety(ArmSafetyMode::Normal);  // the device alone does not end it
  idle(0.2);
  EXPECT_TRUE(controller.tracking().protective_stop);
  arm.setSafety(ArmSafetyMode::ProtectiveStop);

  ASSERT_TRUE(controller.releaseProtectiveStop());
  EXPECT_EQ(arm.releases(), 1);
  idle(0.5);
  EXPECT_FALSE(controller.tracking().protective_stop);
  EXPECT_LT((controller.tracking().q_command - pushed).norm(), 1e-9);
  for (std::size_t k = sent_before; k < arm.sent().size(); ++k) {
    ASSERT_LT((arm.sent()[k].q - pushed).norm(), 1e-9);
  }
  Vector6d qd = Vector6d::Zero();
  qd[0] = 0.2;
  jog(qd, 0.5);
  EXPECT_GT(controller.tracking().q_command[0], pushed[0] + 0.02);
}

TEST_F(ArmControllerTest, GuardedMotionStopsOnContactAndLatchesUntilHold) {
  stream(0.4, 1.0, 0.8, 40.0);
  EXPECT_FALSE(controller.tracking().contact_stop);
  arm.setForce({50, 20, 0});
  stream(0.1, 1.0, 0.4, 40.0);
  EXPECT_TRUE(controller.tracking().contact_stop);
  arm.setForce({0, 0, 0});
  idle(0.5);
  EXPECT_TRUE(controller.tracking().at_rest);
  stream(0.1, 1.0, 0.2, 40.0);
  EXPECT_TRUE(controller.tracking().contact_stop);  // the force is gone, the latch is not
  controller.setpoint({.kind = Kind::Hold, .stamp = clock.now()});
  tick();
  EXPECT_FALSE(controller.tracking().contact_stop);
  EXPECT_TRUE(controller.tracking().blocked.empty()) << controller.tracking().blocked;
}

TEST_F(ArmControllerTest, TellsThePayloadOfADeviceThatItMeetsAndZeroesItsForceAtRest) {
  arm.setForce({4, 0, -3});  // what the sensor is off
  idle(0.1);
  ASSERT_EQ(arm.payloads().size(), 1U);
  EXPECT_EQ(arm.payloads()[0].mass_kg, ArmController::Config{}.payload_kg);
  EXPECT_EQ(arm.payloads()[0].p_flange_com, Eigen::Vector3d(0, 0, 0.09));
  EXPECT_EQ(arm.zeroings(), 0) << "the told payload has not settled";
  idle(0.5);
  EXPECT_EQ(arm.zeroings(), 1);
  EXPECT_LT(controller.tracking().contact_force_n, 0.1);
  arm.freezeState(true);
  idle(1.2);
  arm.freezeState(false);
  idle(0.6);
  EXPECT_EQ(arm.payloads().size(), 2U) << "it may have been switched off";
  EXPECT_EQ(arm.zeroings(), 2);
}

TEST_F(ArmControllerTest, AForceAtRestThatIsAContactIsNotZeroedAway) {
  arm.setForce({0, 40, 0});
  idle(3.0);
  EXPECT_EQ(arm.zeroings(), 0);
  EXPECT_GT(controller.tracking().contact_force_n, 29.0);
  arm.setForce({0, 0, 0});
  idle(0.5);
  EXPECT_EQ(arm.zeroings(), 1);
}

TEST_F(ArmControllerTest, TellsWhatHangsOnTheHeadWithTheHeadAlsoAfterTheDeviceWasAway) {
  idle(0.6);
  controller.carry({1.0, {0, 0.22, 0.09}});
  idle(0.05);
  ASSERT_EQ(arm.payloads().size(), 2U);
  EXPECT_NEAR(arm.payloads()[1].mass_kg, 6.0, 1e-12);
  EXPECT_LT((arm.payloads()[1].p_flange_com - Eigen::Vector3d(0, 0.22 / 6.0, 0.09)).norm(), 1e-12);
  idle(1.0);
  EXPECT_EQ(arm.payloads().size(), 2U) << "said once";
  arm.freezeState(true);
  idle(1.2);
  arm.freezeState(false);
  idle(0.6);
  EXPECT_NEAR(arm.payloads().back().mass_kg, 6.0, 1e-12);
  controller.carry({});
  idle(0.05);
  EXPECT_EQ(arm.payloads().back().mass_kg, ArmController::Config{}.payload_kg);
}

TEST_F(ArmControllerTest, ZeroesTheForceWhenAskedAtRestAndSaysSo) {
  idle(0.6);
  const auto before = controller.tracking().zeroings;
  arm.setForce({0, 6, -5});  // it has drifted
  controller.zeroForce();
  idle(0.1);
  EXPECT_EQ(controller.tracking().zeroings, before);
  idle(0.6);
  EXPECT_EQ(controller.tracking().zeroings, before + 1);
  EXPECT_LT(controller.tracking().contact_force_n, 0.1);
  arm.setForce({0, 6, -45});
  controller.zeroForce();
  idle(2.0);
  EXPECT_EQ(controller.tracking().zeroings, before + 1) << "that is a contact";
}

TEST_F(ArmControllerTest, StopsWhenTheStateIsStale) {
  stream(0.4, 1.0, 0.8);
  arm.freezeState(true);
  stream(0.1, 1.0, 0.5);
  EXPECT_NE(controller.tracking().blocked.find("arm state is"), std::string::npos);
  const Vector6d q = controller.tracking().q_command;
  idle(0.2);
  EXPECT_EQ((controller.tracking().q_command - q).norm(), 0.0);
}

TEST_F(ArmControllerTest, AJammedArmStopsAndTheCommandReturnsToTheJointsOnHold) {
  Vector6d qd = Vector6d::Zero();
  qd[0] = 0.5;
  arm.jam(true);
  jog(qd, 1.5);
  EXPECT_NE(controller.tracking().blocked.find("does not follow"), std::string::npos);
  const std::size_t sent = arm.sent().size();
  idle(0.3);
  EXPECT_EQ(arm.sent().size(), sent);  // nothing presses on
  arm.jam(false);
  jog(qd, 0.3);
  EXPECT_EQ(arm.sent().size(), sent);  // still latched
  controller.setpoint({.kind = Kind::Hold, .stamp = clock.now()});
  idle(0.1);
  EXPECT_LT((controller.tracking().q_command - arm.state()->q).norm(), 1e-6);
  jog(qd, 0.5);
  EXPECT_TRUE(controller.tracking().blocked.empty()) << controller.tracking().blocked;
  EXPECT_GT(arm.sent().size(), sent);
}

TEST_F(ArmControllerTest, PeopleWhoMoveTheArmDoNotMakeItJumpBack) {
  idle(0.5);
  const std::size_t sent = arm.sent().size();
  Vector6d moved = arm.state()->q;
  moved[0] += 1.0;  // a reset: carried back and folded
  arm.setQ(moved);
  idle(1.0);
  EXPECT_EQ(arm.sent().size(), sent);
  controller.setpoint({.kind = Kind::Hold, .stamp = clock.now()});
  idle(0.5);
  ASSERT_GT(arm.sent().size(), sent);
  for (std::size_t k = sent; k < arm.sent().size(); ++k) {
    ASSERT_LT((arm.sent()[k].q - moved).norm(), 1e-6);
  }
  EXPECT_EQ(arm.state()->safety, ArmSafetyMode::Normal);
}

TEST_F(ArmControllerTest, BeginsAnewFromTheJointsAfterLostTicks) {
  Vector6d qd = Vector6d::Zero();
  qd[0] = 0.8;
  jog(qd, 1.0);
  const Vector6d before = controller.tracking().q_command;
  for (int k = 0; k < 60; ++k) {  // half a second in which the daemon did not run
    clock.advanceBy(kTick);
    arm.advance();
  }
  Vector6d sagged = arm.state()->q;
  sagged[1] += 0.05;
  arm.setQ(sagged);
  const std::size_t sent = arm.sent().size();
  idle(0.1);
  ASSERT_GT(arm.sent().size(), sent);
  EXPECT_LT((arm.sent()[sent].q - sagged).norm(), 0.01);
  EXPECT_GT((sagged - before).norm(), 0.04);
}

TEST_F(ArmControllerTest, FollowsAnUnpoweredArmAndDoesNotMoveWhenPowerReturns) {
  arm.setPowered(false);
  Vector6d sagged = arm.state()->q;
  sagged[1] += 0.05;
  arm.setQ(sagged);
  idle(0.2);
  EXPECT_EQ(controller.tracking().blocked, "arm is not powered");
  arm.setPowered(true);
  idle(0.3);
  EXPECT_LT((controller.tracking().q_command - sagged).norm(), 1e-9);
}

}  // namespace
}  // namespace kiln
