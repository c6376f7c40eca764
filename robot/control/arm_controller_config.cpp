#include "robot/control/arm_controller.h"

namespace kiln {

void ArmController::Config::visit(ConfigArchive& a) {
  a.field("servo_rate_hz", servo_rate_hz, "Hz", 50, 500, "control tick; 500 for a UR10e");
  a.field("max_speed_scale", max_speed_scale, "", 0.01, 1, "of the vendor's joint speed limits");
  a.field("max_accel_radps2", max_accel_radps2, "rad/s^2", 0.1, 20, "each joint");
  a.field("max_jerk_radps3", max_jerk_radps3, "rad/s^3", 1, 500, "each joint");
  a.field("stop_decel_radps2", stop_decel_radps2, "rad/s^2", 1, 40, "on STOP, contact and loss");
  a.field("stop_jerk_radps3", stop_jerk_radps3, "rad/s^3", 10, 2000, "ramp-in of the stop");
  a.field("tracking_gain_hz", tracking_gain_hz, "1/s", 0.5, 20, "joint error to correcting speed");
  a.field("max_lead_s", max_lead_s, "s", 0.02, 1, "targets further ahead at full speed are jumps");
  a.field("limit_margin_deg", limit_margin_deg, "deg", 0, 20, "soft limits inside the joint range");
  a.field("max_tracking_error_deg", max_tracking_error_deg, "deg", 1, 60, "more stops the arm");
  a.field("max_state_age_s", max_state_age_s, "s", 0.01, 0.5, "older arm states mean stop");
  a.field("future_tolerance_s", future_tolerance_s, "s", 0, 0.5, "setpoints further ahead refused");
  a.field("force_filter_s", force_filter_s, "s", 0.001, 0.5, "low-pass of the contact force");
  a.field("force_bias_filter_s", force_bias_filter_s, "s", 0.1, 60, "slow mean of the force");
  a.field("max_force_bias_n", max_force_bias_n, "N", 0, 50, "largest mean that is taken away");
  a.field("payload_kg", payload_kg, "kg", 0, 12.5, "what the arm is told to carry");
  a.field("payload_com_m", payload_com_m, "m", -1, 1, "its centre of mass in flange");
  a.field("max_zero_force_n", max_zero_force_n, "N", 0, 100,
          "more at rest is a contact: not zeroed");
}

}  // namespace kiln
