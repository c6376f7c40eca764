#include "robot/control/arm_setpoint_check.h"

#include <cmath>

#include <fmt/format.h>

#include "common/core/units.h"

namespace kiln {
namespace {
constexpr double kRounding = 1e-6;
}  // namespace

bool isFinite(const ArmSetpoint& setpoint) {
  return setpoint.q.allFinite() && setpoint.qd.allFinite() && std::isfinite(setpoint.stop_force_n);
}

std::string refusal(const ArmSetpoint& setpoint, const Vector6d& q_command,
                    const ArmSetpointLimits& limits) {
  if (!isFinite(setpoint)) return "setpoint is not a number";
  if (setpoint.kind != ArmSetpoint::Kind::Joints) return "";
  for (int i = 0; i < 6; ++i) {
    const bool inwards = std::abs(setpoint.q[i]) <= std::abs(q_command[i]) + kRounding;
    if (std::abs(setpoint.q[i]) > limits.position[i] && !inwards) {
      return fmt::format("joint {} target {:.1f} deg is outside +-{:.1f} deg", i + 1,
                         setpoint.q[i] / kDeg, limits.position[i] / kDeg);
    }
    if (std::abs(setpoint.qd[i]) > limits.speed[i] * (1.0 + kRounding)) {
      return fmt::format("joint {} speed {:.0f} deg/s is above {:.0f} deg/s", i + 1,
                         setpoint.qd[i] / kDeg, limits.speed[i] / kDeg);
    }
    const double lead = std::abs(setpoint.q[i] - q_command[i]);
    if (lead > limits.speed[i] * limits.max_lead_s) {
      return fmt::format("joint {} target jumps by {:.1f} deg; plan a path to it", i + 1,
                         lead / kDeg);
    }
  }
  return "";
}

}  // namespace kiln
