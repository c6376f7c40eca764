#include "robot/app/controller_limits.h"

#include <cmath>

#include <gtest/gtest.h>

#include "robot/app/robot_settings.h"

namespace kiln {
namespace {

std::vector<std::string> broken(const RobotSettings& settings) {
  std::vector<std::string> keys;
  for (const LimitRow& row : controllerLimits(settings, RobotGeometry{})) {
    if (!row.kept()) keys.push_back(row.key);
  }
  return keys;
}

TEST(ControllerLimits, TheDefaultsKeepThem) { EXPECT_TRUE(broken(RobotSettings{}).empty()); }

TEST(ControllerLimits, AnOuterWheelFasterThanItsMotorIsNamed) {
  RobotSettings settings;
  settings.base.max_speed_mps = 3.5;  // and 0.8 rad/s at 0.91 m: 4.2 m/s
  EXPECT_EQ(broken(settings), std::vector<std::string>{"base.max_speed_mps"});
  const auto rows = controllerLimits(settings, RobotGeometry{});
  EXPECT_EQ(rows.front().text(),
            "base.max_speed_mps is 4.23 m/s, more than 4 m/s (hub motors; outer wheel when it also "
            "turns)");
}

TEST(ControllerLimits, ABrakingThatIsPromisedIsHeld) {
  RobotSettings settings;
  settings.base.stop_decel_mps2 = 1.0;
  EXPECT_EQ(broken(settings), std::vector<std::string>{"base.stop_decel_mps2"});
  settings.base.stop_decel_mps2 = 6.0;  // more than the drives can do
  EXPECT_EQ(broken(settings), std::vector<std::string>{"base.stop_decel_mps2"});
}

TEST(ControllerLimits, ASkillThatAsksForMoreThanItsControllerGivesIsNamed) {
  RobotSettings settings;
  settings.move_arm.speed_scale = 0.9;
  settings.teleop.max_speed_mps = 2.0;
  EXPECT_EQ(broken(settings),
            (std::vector<std::string>{"move_arm.speed_scale", "teleop.max_speed_mps"}));
}

TEST(ControllerLimits, WhatADeviceReportsMustLieWithinThem) {
  const RobotSettings settings;
  RobotGeometry robot;
  ArmState arm;
  BaseState base;
  EXPECT_EQ(reportedBeyondLimits(settings, robot, arm, base), "");
  EXPECT_EQ(reportedBeyondLimits(settings, robot, std::nullopt, std::nullopt), "");
  arm.q[2] = robot.arm.position_limit[2];  // inside the vendor's, beyond ours
  EXPECT_NE(reportedBeyondLimits(settings, robot, arm, base).find("joint 3 stands at"),
            std::string::npos);
  arm.q[2] = 0.0;
  arm.qd[5] = std::nan("");
  EXPECT_NE(reportedBeyondLimits(settings, robot, arm, base).find("joint 6 reports"),
            std::string::npos);
  arm.qd[5] = 0.0;
  base.wheels[1].steer_rad = 4.0;
  EXPECT_NE(reportedBeyondLimits(settings, robot, arm, base).find("wheel 2 is steered"),
            std::string::npos);
}

}  // namespace
}  // namespace kiln
