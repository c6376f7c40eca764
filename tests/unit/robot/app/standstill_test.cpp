#include "robot/app/standstill.h"

#include <cmath>
#include <functional>

#include <gtest/gtest.h>

namespace kiln {
namespace {

using std::chrono::milliseconds;

struct Devices {
  Stamp now{std::chrono::seconds(10)};
  ArmState arm;
  BaseState base;
  PumpsState pumps;
  Devices() { arm.stamp = base.stamp = pumps.stamp = now; }
  [[nodiscard]] StopStatus status() const {
    StopStatus out;
    out.latched = true;
    proveStandstill(out, arm, base, pumps, now);
    return out;
  }
};

TEST(Standstill, ASpeedOfSilentWheelsIsUnknown) {
  Devices devices;
  const Twist2 measured{0.5, 0, 0.1};
  EXPECT_EQ(knownTwist(measured, devices.base, devices.now).vx_mps, 0.5);
  const Stamp later = devices.now + milliseconds(150);
  const Twist2 unknown = knownTwist(measured, devices.base, later);
  EXPECT_TRUE(std::isnan(unknown.vx_mps) && std::isnan(unknown.vy_mps) &&
              std::isnan(unknown.wz_radps));
  EXPECT_TRUE(std::isnan(knownTwist(measured, std::nullopt, devices.now).vx_mps));
}

TEST(Standstill, IsProvenByFreshFiniteMeasurementsOfAllThree) {
  Devices resting;
  EXPECT_TRUE(resting.status().standstill_proven);
  StopStatus clear;
  proveStandstill(clear, resting.arm, resting.base, resting.pumps, resting.now);
  EXPECT_FALSE(clear.standstill_proven) << "no STOP is latched";
  EXPECT_TRUE(clear.base_at_rest);
  StopStatus silent;
  silent.latched = true;
  proveStandstill(silent, std::nullopt, std::nullopt, std::nullopt, resting.now);
  EXPECT_FALSE(silent.standstill_proven || silent.arm_at_rest || silent.base_at_rest ||
               silent.pumps_at_rest);
}

TEST(Standstill, WhatMovesIsSilentOrIsNoNumberProvesNothingOfItsOwnPart) {
  using Break = std::function<void(Devices&)>;
  const std::vector<Break> arm{[](auto& d) { d.arm.qd[5] = 0.05; },
                               [](auto& d) { d.arm.qd[0] = NAN; },
                               [](auto& d) { d.arm.stamp = d.now - milliseconds(150); },
                               [](auto& d) { d.arm.stamp = d.now + milliseconds(150); }};
  const std::vector<Break> base{[](auto& d) { d.base.wheels[3].drive_radps = -0.3; },
                                [](auto& d) { d.base.wheels[1].drive_radps = NAN; },
                                [](auto& d) { d.base.stamp = d.now - milliseconds(150); }};
  const std::vector<Break> pumps{[](auto& d) { d.pumps.current_a[1] = 3.0; },
                                 [](auto& d) { d.pumps.current_a[0] = NAN; },
                                 [](auto& d) { d.pumps.stamp = d.now - milliseconds(150); }};
  const auto rest = [](const Break& breakIt) {
    Devices devices;
    breakIt(devices);
    const StopStatus s = devices.status();
    EXPECT_FALSE(s.standstill_proven);
    return std::array{s.arm_at_rest, s.base_at_rest, s.pumps_at_rest};
  };
  for (const Break& b : arm) EXPECT_EQ(rest(b), (std::array{false, true, true}));
  for (const Break& b : base) EXPECT_EQ(rest(b), (std::array{true, false, true}));
  for (const Break& b : pumps) EXPECT_EQ(rest(b), (std::array{true, true, false}));
}

TEST(Standstill, ASilentBaseTellsNeitherItsSpeedNorItsBattery) {
  Devices devices;
  devices.base.battery_v = 47.5;
  EXPECT_EQ(knownOf(devices.base, &BaseState::battery_v, devices.now), 47.5);
  EXPECT_EQ(knownTwist({0.3, 0, 0}, devices.base, devices.now).vx_mps, 0.3);
  devices.base.stamp = devices.now - milliseconds(150);
  EXPECT_TRUE(std::isnan(knownOf(devices.base, &BaseState::battery_v, devices.now)));
  EXPECT_TRUE(std::isnan(knownTwist({0.3, 0, 0}, devices.base, devices.now).vx_mps));
  EXPECT_TRUE(std::isnan(knownOf(std::nullopt, &BaseState::battery_v, devices.now)));
}

}  // namespace
}  // namespace kiln
