#pragma once

#include <gtest/gtest.h>

#include "common/config/resources.h"
#include "common/core/units.h"
#include "robot/control/base_controller.h"
#include "robot/sim/world.h"

namespace kiln::sim {

/// The robot's own base controller on the simulated wheels: one control tick every 8 ms.
struct DrivenWorld {
  class Wheels final : public DriveBase {
   public:
    [[nodiscard]] std::optional<BaseState> state() const override { return state_; }
    Result<void> write(const WheelCommands& command) override {
      command_ = command;
      return {};
    }
    std::optional<BaseState> state_;
    std::optional<WheelCommands> command_;
  };

  explicit DrivenWorld(const WorldConfig& config = fullWorld(), std::uint64_t seed = 1,
                       BaseController::Config control = {})
      : world(std::move(*World::create(config, seed))),
        controller(control, world->robot(), wheels, stop) {
    run(0.5);  // comes to rest on its wheels
  }
  static WorldConfig fullWorld() { return *WorldConfig::load(*resourcePath("worlds/fire.yaml")); }
  /// As surveyed: nothing is drawn, the robot stands exactly at the origin, its wheels are all
  /// alike.
  static WorldConfig nominalWorld() {
    WorldConfig config = fullWorld();
    config.perturbation = {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0};
    config.base.wheel_radius_sigma = config.base.steer_offset_sigma_deg = 0.0;
    return config;
  }

  void tick() {
    if (controlled) controller.tick(world->now());
    WorldCommands commands;
    commands.base = std::exchange(wheels.command_, std::nullopt);
    world->command(commands);
    wheels.state_ = world->advance(world->now() + fromSeconds(0.008)).base;
  }
  void run(double seconds) {
    for (const Stamp end = world->now() + fromSeconds(seconds); world->now() < end;) tick();
  }
  void drive(const Twist2& twist, double seconds) {
    for (const Stamp end = world->now() + fromSeconds(seconds); world->now() < end;) {
      controller.setpoint({.stamp = world->now(), .twist = twist});
      tick();
    }
  }
  /// Drives along X at that speed until the base is there, then stops.
  void driveTo(double x_m, double speed_mps) {
    const double braking = 0.5 * speed_mps * speed_mps / 0.8 + 0.1 * speed_mps;
    const Stamp end = world->now() + fromSeconds(60);
    const double sign = x_m > pose().translation().x() ? 1.0 : -1.0;
    while (sign * (x_m - pose().translation().x()) > braking && world->now() < end) {
      controller.setpoint({.stamp = world->now(), .twist = {sign * speed_mps, 0, 0}});
      tick();
    }
    drive({}, 2.0);
  }
  [[nodiscard]] Eigen::Isometry3d pose() const { return world->truth().X_map_base; }
  [[nodiscard]] double pitchDeg() const {  // nose up positive
    return std::asin(pose().linear()(2, 0)) / kDeg;
  }

  std::unique_ptr<World> world;
  Wheels wheels;
  StopLatch stop;
  BaseController controller;
  bool controlled = true;  ///< false: the controller has died
};

}  // namespace kiln::sim
