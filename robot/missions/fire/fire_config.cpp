#include "robot/missions/fire/fire_config.h"

namespace kiln {

void FireDriveConfig::visit(ConfigArchive& a) {
  a.field("clearance_m", clearance_m, "m", 0.0, 2.0,
          "beside the robot when a way-point is left out");
  a.field("stow_tolerance_deg", stow_tolerance_deg, "deg", 0.1, 20.0,
          "arm counts as in its drive pose");
  a.field("time_limit_s", time_limit_s, "s", 5.0, 900.0, "for one drive");
  a.field("max_faults", max_faults, "", 0, 10, "retries of a failed drive a place");
  a.field("rest_s", rest_s, "s", 0.0, 30.0, "before a retry");
}

void FireCheckConfig::visit(ConfigArchive& a) {
  a.field("max_looks", max_looks, "", 1, 20, "until a place counts as misplaced or unseen");
  a.field("between_looks_s", between_looks_s, "s", 0, 10, "the position settles meanwhile");
  a.field("look_timeout_s", look_timeout_s, "s", 0.2, 60, "for one answer");
  a.field("wait_s", wait_s, "s", 0, 3600, "for the operator, then the place is left out");
}

void FireSearchConfig::visit(ConfigArchive& a) {
  a.section("motion", motion, "rectangular search motion");
  a.section("warming", warming, "a place that still warms is searched again");
  a.field("max_searches", max_searches, "", 1, 10, "of a plate that was glimpsed, a place");
  a.field("max_rounds", max_rounds, "", 1, 10, "over all places while no fire was found");
  a.field("place_gate_m", place_gate_m, "m", 0.05, 5.0,
          "estimates farther from the configured plate are refused");
  a.field("image_timeout_s", image_timeout_s, "s", 0.2, 30.0, "without thermal images");
  a.field("time_limit_s", time_limit_s, "s", 5.0, 600.0, "for one search");
}

void FireAimConfig::visit(ConfigArchive& a) {
  a.section("solver", solver, "choice of the spray pose");
  a.field("step_m", step_m, "m", 0.01, 0.5, "longest arm motion between measurements");
  a.field("max_turn_deg", max_turn_deg, "deg", 1.0, 90.0, "largest turn of one step");
  a.field("settle_views", settle_views, "", 0, 50, "sightings awaited after a step");
  a.field("settle_s", settle_s, "s", 0.0, 10.0, "at most this long");
  a.field("lost_after_s", lost_after_s, "s", 0.2, 30.0, "of usable images without the heat source");
  a.field("max_losses", max_losses, "", 0, 10, "searches anew a place");
  a.field("max_sigma_m", max_sigma_m, "m", 0.001, 0.5, "largest standard deviation to spray at");
  a.field("position_tolerance_m", position_tolerance_m, "m", 0.001, 0.1, "nozzle has arrived");
  a.field("angle_tolerance_deg", angle_tolerance_deg, "deg", 0.1, 10.0, "nozzle has arrived");
  a.field("hold_tolerance_m", hold_tolerance_m, "m", 0.002, 0.2,
          "arm still counts as at its spray pose");
  a.field("hold_tolerance_deg", hold_tolerance_deg, "deg", 0.2, 20.0,
          "arm still counts as at its spray pose");
  a.field("time_limit_s", time_limit_s, "s", 5.0, 600.0, "for aiming");
}

void FireSprayConfig::visit(ConfigArchive& a) {
  a.field("litres_per_fire", litres_per_fire, "l", 0.1, 10.0, "estimated by the pump model");
  a.field("steady_share", steady_share, "", 0.0, 1.0,
          "phase 1: this share of the water is sprayed steadily");
  a.field("duty", duty, "", 0.1, 1.0, "of both pumps");
  a.field("min_current_a", min_current_a, "A", 0.05, 20.0, "drawn by a running pump");
  a.field("start_timeout_s", start_timeout_s, "s", 0.5, 30.0, "until the pumps draw current");
  a.field("idle_fault_s", idle_fault_s, "s", 0.2, 10, "pumps that stay off so long are a fault");
  a.field("off_current_a", off_current_a, "A", 0.01, 5.0, "below it a pump has stopped");
  a.field("min_start_l", min_start_l, "l", 0.0, 5.0, "a tank with less is not started");
  a.field("delivered_share", delivered_share, "", 0.1, 1.0,
          "of the water: the place counts as extinguished");
  a.field("phase_limit_factor", phase_limit_factor, "", 1.1, 10.0,
          "of the expected time of a phase");
  a.field("flow_lpm", flow_lpm, "l/min", 0.1, 20.0, "both pumps, for the expected time");
  a.field("tank_l", tank_l, "l", 0.1, 50.0, "each tank when full");
  a.field("macro_check_after_s", macro_check_after_s, "s", 0.5, 10.0,
          "a pump without current by then fails a macro's step");
  a.section("pattern", pattern, "phase 2: hourglass");
}

void FireFaultConfig::visit(ConfigArchive& a) {
  a.field("pump_rest_s", pump_rest_s, "s", 0.0, 30.0, "before a retry");
  a.field("max_pump_faults", max_pump_faults, "", 0, 10, "retries a place");
  a.field("back_off_s", back_off_s, "s", 0.0, 10,
          "of its way that the arm goes back after a contact");
  a.field("arm_rest_s", arm_rest_s, "s", 0.0, 10.0, "before a retry");
  a.field("max_arm_faults", max_arm_faults, "", 0, 10, "retries a place");
  a.field("max_blocked_in_row", max_blocked_in_row, "", 1, 50,
          "arm faults without a drive between, then safe stop");
  a.field("release_rest_s", release_rest_s, "s", 0.0, 30.0,
          "after the release of a protective stop");
}

void NudgeConfig::visit(ConfigArchive& a) {
  a.field("max_m", max_m, "m", 0.0, 2.0,
          "an operator moves a place at most this far at a time, each axis");
  a.field("max_deg", max_deg, "deg", 0.0, 90.0, "and turns it at most this far");
}

void FireClockConfig::visit(ConfigArchive& a) {
  a.field("limit_s", limit_s, "s", 60.0, 3600.0, "mission clock");
  a.field("wrap_up_s", wrap_up_s, "s", 0.0, 300.0, "before its end: pumps off, arm parked");
  a.field("park_limit_s", park_limit_s, "s", 1.0, 300.0, "for parking the arm");
}

void FireConfig::visit(ConfigArchive& a) {
  a.section("drive", drive, "driving between places");
  a.section("check", check, "configured against sensed place");
  a.section("search", search, "looking for the heat source");
  a.section("aim", aim, "bringing the nozzle to its spray pose");
  a.section("spray", spray, "water");
  a.section("faults", faults, "what is tried again");
  a.section("nudge", nudge, "moving a place by hand");
  a.section("clock", clock, "mission clock");
}

}  // namespace kiln
