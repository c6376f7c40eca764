#include "robot/skills/move_arm.h"

namespace kiln {

void MoveArm::Config::visit(ConfigArchive& a) {
  a.field("speed_scale", speed_scale, "", 0.01, 1, "of the joint speed limits");
  a.field("cartesian_speed_mps", cartesian_speed_mps, "m/s", 0.005, 1.5, "along straight lines");
  a.field("cartesian_accel_mps2", cartesian_accel_mps2, "m/s^2", 0.05, 5, "along straight lines");
  a.field("guard_force_n", guard_force_n, "N", 0, 150, "contact force that stops; 0 = unguarded");
  a.field("clearance_m", clearance_m, "m", 0, 0.3, "to base, tanks, scene and itself");
  a.field("joint_accel_radps2", joint_accel_radps2, "rad/s^2", 0.1, 20, "each joint");
  a.field("jerk_time_s", jerk_time_s, "s", 0.02, 1, "ramp of the acceleration");
  a.field("goal_tolerance_deg", goal_tolerance_deg, "deg", 0.05, 10, "measured joints at the end");
  a.field("settle_timeout_s", settle_timeout_s, "s", 0.2, 20, "to rest before and after");
  a.field("planning_slice", planning_slice, "", 1, 10000, "search iterations in one poll");
  a.field("max_resumes", max_resumes, "", 0, 100, "of one move, when nothing was touched");
  a.field("max_gap_s", max_gap_s, "s", 0.06, 5, "between two polls; longer interrupts the move");
  a.section("planner", planner, "search for a way around obstacles");
  a.section("cartesian", cartesian, "straight lines");
  a.section("watch", watch, "live cloud where the arm would pass");
}

}  // namespace kiln
