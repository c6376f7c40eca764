#pragma once

#include <string>

#include "robot/control/arm_controller.h"

namespace kiln {

/// What a joint setpoint is judged by.
struct ArmSetpointLimits {
  Vector6d position = Vector6d::Zero();  ///< +- rad, soft
  Vector6d speed = Vector6d::Zero();     ///< rad/s
  double max_lead_s = 0.2;
};

/// Finite numbers only: everything a setpoint carries.
[[nodiscard]] bool isFinite(const ArmSetpoint& setpoint);
/// Why this setpoint must not be followed from the present command, as one sentence; empty if it
/// may.
[[nodiscard]] std::string refusal(const ArmSetpoint& setpoint, const Vector6d& q_command,
                                  const ArmSetpointLimits& limits);

}  // namespace kiln
