#include <cmath>

#include <gtest/gtest.h>

#include "robot/sim/world.h"

namespace kiln::sim {
namespace {

constexpr double kPeriod = 0.008;
constexpr double kGravity_mps2 = 9.81;
constexpr std::size_t kWrist1 = 3;

/// The arm of a world on flat ground, without a robot: commands as a test gives them.
class ForceSensorTest : public testing::Test {
 protected:
  ForceSensorTest() : world(std::move(*World::create({}, 3))) {
    q = RobotGeometry::radians(world->robot().q_park_deg);
    (void)mean(0.3);
  }
  WorldReport step(const WorldCommands& commands) {
    world->command(commands);
    return world->advance(world->now() + fromSeconds(kPeriod));
  }
  Eigen::Vector3d mean(double seconds) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    const int count = static_cast<int>(seconds / kPeriod);
    for (int i = 0; i < count; ++i) sum += step({}).arm.wrench_tool.head<3>();
    return sum / count;
  }
  void tell(double mass_kg) {
    WorldCommands commands;
    commands.payload = ArmPayload{mass_kg, {0, 0, 0.09}};
    (void)step(commands);
    (void)mean(0.3);
  }
  void zero() {
    WorldCommands commands;
    commands.zero_force = true;
    (void)step(commands);
  }
  /// Turns wrist 1 by so much on a smooth way. @return the largest force on it.
  double turn(double angle_rad, double duration_s) {
    double most = 0.0;
    const double from = q[kWrist1];
    for (double t = 0.0; t < duration_s; t += kPeriod) {
      const double s = t / duration_s, p = s * s * s * (10 - 15 * s + 6 * s * s);
      Vector6d qd = Vector6d::Zero();
      qd[kWrist1] = angle_rad * 30 * s * s * (1 - s) * (1 - s) / duration_s;
      q[kWrist1] = from + p * angle_rad;
      WorldCommands commands;
      commands.arm = ArmServo{q, qd};
      const WorldReport report = step(commands);
      most = std::max(most, report.arm.wrench_tool.head<3>().norm());
      EXPECT_EQ(report.refused, "") << t;
    }
    EXPECT_LT((step({}).arm.q - q).cwiseAbs().maxCoeff(), 0.05);
    return most;
  }
  [[nodiscard]] Eigen::Vector3d downInFlange() const {
    return world->robot().X_base_flange(q).linear().transpose() * -Eigen::Vector3d::UnitZ();
  }
  [[nodiscard]] double headN() const { return world->arena().robot.head_kg * kGravity_mps2; }

  std::unique_ptr<World> world;
  Vector6d q;
};

TEST_F(ForceSensorTest, FeelsTheHeadAndItsOwnOffsetUntilToldAndZeroed) {
  const double off_n = std::sqrt(3.0) * world->config().arm.force_offset_n;
  EXPECT_NEAR(mean(1.0).norm(), headN(), off_n);
  tell(world->arena().robot.head_kg);
  EXPECT_LT(mean(1.0).norm(), off_n);
  EXPECT_GT(mean(1.0).norm(), 0.5) << "its offset is left";
  zero();
  EXPECT_LT(mean(1.0).norm(), 0.4) << "noise of 1 N, 125 samples, three axes";
}

TEST_F(ForceSensorTest, AHeadThatWasZeroedButNotToldWeighsWhenItTurns) {
  zero();
  EXPECT_LT(mean(1.0).norm(), 0.4);
  const Eigen::Vector3d before = downInFlange();
  (void)turn(-0.5 * M_PI, 2.0);
  // Zeroed in the sensor's axes, while the weight keeps its direction.
  EXPECT_NEAR(mean(1.0).norm(), (downInFlange() - before).norm() * headN(), 3.0);
  EXPECT_GT((downInFlange() - before).norm(), 1.0);
}

TEST_F(ForceSensorTest, AToldHeadWeighsNothingWhereverItPoints) {
  tell(5.0);  // the true one is off by up to 0.1 kg and 5 mm
  zero();
  EXPECT_LT(turn(-0.5 * M_PI, 1.5), 12.0) << "accelerations are taken off too";
  EXPECT_LT(mean(1.0).norm(), 2.0);
}

TEST_F(ForceSensorTest, TooHeavyAPayloadIsRefused) {
  WorldCommands commands;
  commands.payload = ArmPayload{13.0, Eigen::Vector3d::Zero()};
  EXPECT_NE(step(commands).refused.find("payload of 13.0 kg"), std::string::npos);
}

TEST_F(ForceSensorTest, DriftsByTwoNewtonInTenMinutes) {
  tell(world->arena().robot.head_kg);
  zero();
  const Eigen::Vector3d before = mean(4.0);
  (void)world->advance(world->now() + fromSeconds(116.0));
  EXPECT_NEAR((mean(4.0) - before).norm(), 0.4, 0.15);
}

}  // namespace
}  // namespace kiln::sim
