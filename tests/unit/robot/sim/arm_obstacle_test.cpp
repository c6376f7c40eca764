#include "robot/sim/arm_obstacle.h"

#include <algorithm>
#include <initializer_list>

#include <gtest/gtest.h>

#include "robot/control/arm_controller.h"
#include "robot/sim/world.h"

namespace kiln::sim {
namespace {

constexpr double kPeriod = 0.008;
constexpr double kGuard_n = 40.0;  // MoveArm::Config::guard_force_n

/// The robot's own arm controller on the simulated arm: one control tick every 8 ms, setpoints at
/// 50 Hz.
class ArmObstacleTest : public testing::Test {
 protected:
  class Servo final : public Arm {
   public:
    [[nodiscard]] std::optional<ArmState> state() const override { return state_; }
    Result<void> servo(const ArmServo& target) override {
      target_ = target;
      return {};
    }
    Result<void> releaseProtectiveStop() override { return {}; }
    Result<void> setPayload(const ArmPayload& payload) override {
      payload_ = payload;
      return {};
    }
    Result<void> zeroForceSensor() override {
      zero_ = true;
      return {};
    }
    std::optional<ArmState> state_;
    std::optional<ArmServo> target_;
    std::optional<ArmPayload> payload_;
    bool zero_ = false;
  };

  void make(const std::string& fault) {
    WorldConfig config;
    config.faults.push_back(*FaultConfig::parse(fault));
    world = std::move(*World::create(config, 1));
    servo = {};
    controller.emplace(ArmController::Config{}, world->robot(), servo, stop);
    runUntil(0.6);  // the controller has seen the arm at rest and zeroed its force sensor
    felt_n = 0.0;
  }
  void runUntil(double t_s) {
    while (toSeconds(world->now()) < t_s) tick();
  }
  void tick() {
    controller->tick(world->now());
    WorldCommands commands;
    commands.arm = std::exchange(servo.target_, std::nullopt);
    commands.payload = std::exchange(servo.payload_, std::nullopt);
    commands.zero_force = std::exchange(servo.zero_, false);
    world->command(commands);
    servo.state_ = world->advance(world->now() + fromSeconds(kPeriod)).arm;
    felt_n = std::max(felt_n, servo.state_->wrench_tool.head<3>().norm());
  }
  /// Guarded, from where the arm stands to `change` further, evenly but for the first and last
  /// 0.5 s; ends early on a contact.
  void move(const Vector6d& change, double duration_s) {
    const Vector6d from = controller->tracking().q_command;
    const double ramp = 0.5, cruise = duration_s - ramp;
    for (int k = 0; k * kPeriod < duration_s && !controller->tracking().contact_stop; ++k) {
      const double t = k * kPeriod, left = duration_s - t;
      const double done = t < ramp      ? t * t / (2 * ramp)
                          : left < ramp ? cruise - left * left / (2 * ramp)
                                        : t - ramp / 2;
      const double rate = std::min({1.0, t / ramp, left / ramp});
      if (k % 2 == 0) {
        controller->setpoint({.kind = ArmSetpoint::Kind::Joints,
                              .stamp = world->now(),
                              .q = from + change * done / cruise,
                              .qd = change * rate / cruise,
                              .stop_force_n = kGuard_n});
      }
      tick();
    }
  }
  static Vector6d joints(std::initializer_list<double> deg) {
    Vector6d q;
    std::transform(deg.begin(), deg.end(), q.data(), [](double d) { return d * M_PI / 180; });
    return q;
  }

  std::unique_ptr<World> world;
  Servo servo;
  StopLatch stop;
  std::optional<ArmController> controller;
  double felt_n = 0.0;
};

struct Motion {
  const char* what;
  std::initializer_list<double> change_deg;
  double duration_s;
  double limit_n = 100.0;  ///< of the reduced zones, where the robot moves like this
};

constexpr std::initializer_list<double> kUnfold_deg = {0, 60, -60, 0, 0, 0};

// The head at 0.2 to 0.6 m/s.
TEST_F(ArmObstacleTest, AGuardedMotionMeetsItAndStopsWithoutAProtectiveStop) {
  for (const Motion& motion :
       {Motion{"reaching", {0, 30, -30, 0, 0, 0}, 3.0}, Motion{"turning", {60, 0, 0, 0, 0, 0}, 4.0},
        Motion{"fast", {60, 0, 0, 0, 0, 0}, 2.5, 150.0},
        Motion{"withdrawing", {0, -50, 50, 0, 0, 0}, 4.0}}) {
    SCOPED_TRACE(motion.what);
    make("arm_obstacle@5");
    move(joints(kUnfold_deg), 4.0);
    runUntil(5.2);
    felt_n = 0.0;
    move(joints(motion.change_deg), motion.duration_s);
    EXPECT_TRUE(controller->tracking().contact_stop) << controller->tracking().blocked;
    runUntil(toSeconds(world->now()) + 1.0);
    EXPECT_EQ(servo.state_->safety, ArmSafetyMode::Normal);
    EXPECT_TRUE(controller->tracking().at_rest);
    EXPECT_GT(felt_n, kGuard_n);
    const auto collisions = world->truth().collisions;
    EXPECT_FALSE(collisions.empty());
    for (const Collision& collision : collisions) {
      EXPECT_EQ(collision.b, "obstacle") << collision.a;
      EXPECT_LT(collision.force_n, motion.limit_n) << collision.a;
    }
  }
}

TEST_F(ArmObstacleTest, StandsNowhereWhileTheArmRestsAndLeavesWithTheFault) {
  make("arm_obstacle@4:6");
  move(joints(kUnfold_deg), 3.5);
  runUntil(5.0);
  EXPECT_TRUE(world->truth().collisions.empty());
  move(joints({60, 0, 0, 0, 0, 0}), 4.0);
  EXPECT_TRUE(controller->tracking().contact_stop);
  controller->setpoint({.stamp = world->now()});  // Hold: the contact is answered
  runUntil(10.5);
  move(joints({40, 0, 0, 0, 0, 0}), 4.0);
  EXPECT_FALSE(controller->tracking().contact_stop);
  EXPECT_EQ(world->truth().collisions.size(), 1U);
}

}  // namespace
}  // namespace kiln::sim
