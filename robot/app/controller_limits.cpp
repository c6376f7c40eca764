#include "robot/app/controller_limits.h"

#include <algorithm>
#include <cmath>

#include "common/core/units.h"
#include "robot/app/robot_settings.h"

namespace kiln {
namespace {

constexpr double kPromisedStop_mps2 = 1.8;       // resources/docs/safety.md
constexpr double kPromisedSetpointAge_s = 0.25;  // the same
constexpr double kPumpWatchdog_s = 0.2;
constexpr double kSteerSlack_rad = 0.05;
constexpr double kSpeedSlack = 1.1;  // measured speeds are noisy
constexpr double kRounding = 1e-9;

/// Speed of the outermost wheel when the base drives and turns as fast as it may.
double fastestWheel(const BaseController::Config& base, const RobotGeometry& robot) {
  return base.max_speed_mps +
         base.max_yaw_rate_radps * std::hypot(robot.wheel_x_m, robot.wheel_y_m);
}

}  // namespace

bool LimitRow::kept() const {
  if (!std::isfinite(configured)) return false;
  return at_least ? configured >= allowed - kRounding : configured <= allowed + kRounding;
}

std::string LimitRow::text() const {
  return fmt::format("{} is {:.3g} {}, {} than {:.3g} {} ({})", key, configured, unit,
                     at_least ? "less" : "more", allowed, unit, because);
}

std::vector<LimitRow> controllerLimits(const RobotSettings& s, const RobotGeometry& robot) {
  std::vector<LimitRow> rows{
      {"base.max_speed_mps", fastestWheel(s.base, robot), robot.max_wheel_speed_mps, "m/s",
       "hub motors; outer wheel when it also turns"},
      {"base.max_accel_mps2", s.base.max_accel_mps2, robot.max_decel_mps2, "m/s2", "drives"},
      {"base.stop_decel_mps2", s.base.stop_decel_mps2, robot.max_decel_mps2, "m/s2", "drives"},
      {"base.stop_decel_mps2", s.base.stop_decel_mps2, kPromisedStop_mps2, "m/s2",
       "promised braking", true},
      {"base.max_setpoint_age_s", s.base.max_setpoint_age_s, kPromisedSetpointAge_s, "s",
       "promised reaction to silence"},
      {"pumps.max_setpoint_age_s", s.pumps.max_setpoint_age_s, kPumpWatchdog_s, "s",
       "the pump board's own watchdog"},
      {"arm.max_speed_scale", s.arm.max_speed_scale, 1.0, "", "the vendor's joint speeds"},
      {"arm.stop_decel_radps2", s.arm.stop_decel_radps2, s.arm.max_accel_radps2, "rad/s2",
       "arm.max_accel_radps2", true},
      {"move_arm.speed_scale", s.move_arm.speed_scale, s.arm.max_speed_scale, "",
       "arm.max_speed_scale"},
      {"move_arm.joint_accel_radps2", s.move_arm.joint_accel_radps2, s.arm.max_accel_radps2,
       "rad/s2", "arm.max_accel_radps2"},
      {"drive_to.accel_mps2", s.drive_to.accel_mps2, s.base.max_accel_mps2, "m/s2",
       "base.max_accel_mps2"},
  };
  const auto clamped = [&](const char* key, double value, double limit, const char* unit,
                           const char* by) {
    rows.push_back({key, value, limit, unit, by, false, true});
  };
  clamped("drive_to.speed_mps", s.drive_to.speed_mps, s.base.max_speed_mps, "m/s",
          "base.max_speed_mps");
  clamped("drive_to.yaw_rate_radps", s.drive_to.yaw_rate_radps, s.base.max_yaw_rate_radps, "rad/s",
          "base.max_yaw_rate_radps");
  clamped("teleop.max_speed_mps", s.teleop.max_speed_mps, s.base.max_speed_mps, "m/s",
          "base.max_speed_mps");
  clamped("teleop.max_joint_rate_radps", s.teleop.max_joint_rate_radps,
          s.arm.max_speed_scale * robot.arm.velocity_limit.minCoeff(), "rad/s",
          "slowest joint at arm.max_speed_scale");
  return rows;
}

std::string reportedBeyondLimits(const RobotSettings& settings, const RobotGeometry& robot,
                                 const std::optional<ArmState>& arm,
                                 const std::optional<BaseState>& base) {
  const double margin_rad = settings.arm.limit_margin_deg * kDeg;
  for (int i = 0; arm && i < 6; ++i) {
    if (!(std::abs(arm->q[i]) <= robot.arm.position_limit[i] - margin_rad))
      return fmt::format("joint {} stands at {:.0f} deg, the limit is {:.0f}", i + 1,
                         arm->q[i] / kDeg, (robot.arm.position_limit[i] - margin_rad) / kDeg);
    if (!(std::abs(arm->qd[i]) <= kSpeedSlack * robot.arm.velocity_limit[i]))
      return fmt::format("joint {} reports {:.1f} rad/s, it can do {:.1f}", i + 1, arm->qd[i],
                         robot.arm.velocity_limit[i]);
  }
  for (std::size_t i = 0; base && i < base->wheels.size(); ++i) {
    const double steer_rad = base->wheels[i].steer_rad;
    if (!(std::abs(steer_rad) <= robot.steer_limit_deg * kDeg + kSteerSlack_rad))
      return fmt::format("wheel {} is steered to {:.0f} deg, the limit is {:.0f}", i + 1,
                         steer_rad / kDeg, robot.steer_limit_deg);
  }
  return {};
}

}  // namespace kiln
