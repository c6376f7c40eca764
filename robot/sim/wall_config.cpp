#include "robot/sim/wall_config.h"

namespace kiln::sim {

void MagnetConfig::visit(ConfigArchive& a) {
  a.field("flush_n", flush_n, "N", 0, 1e4, "pull of all eight, flush on a plate");
  a.field("half_gap_m", half_gap_m, "m", 1e-6, 0.01, "half the pull at this distance");
  a.field("shear_n", shear_n, "N", 0, 1e4,
          "that all eight hold sideways, flush and without a pull");
  a.field("radius_m", radius_m, "m", 0.001, 0.05, "of a pole");
  a.field("rise_s", rise_s, "s", 0.001, 1, "time constant of the field");
  a.field("current_a", current_a, "A", 0, 10, "of each, switched on");
  a.field("current_noise_a", current_noise_a, "A", 0, 1, "rms");
}

void StorageDeviceConfig::visit(ConfigArchive& a) {
  a.field("compartment_kg", compartment_kg, "kg", 1, 100, "each, without bricks");
  a.field("belt_n", belt_n, "N", 10, 1e4, "the most that a drive pushes with");
  a.field("rotor_kg", rotor_kg, "kg", 1, 1e3, "inertia of motor and gear, at the belt");
  a.field("amperes_per_n", amperes_per_n, "A/N", 0, 1, "of a drive that pushes");
  a.field("idle_a", idle_a, "A", 0, 10, "of a drive at rest");
  a.field("current_noise_a", current_noise_a, "A", 0, 1, "rms");
  a.field("accel_mps2", accel_mps2, "m/s2", 0.01, 10, "of the drives' ramps");
  a.field("friction", friction, "", 0.01, 1, "of bricks on the plates of their bins");
  a.field("jam_s", jam_s, "s", 0.01, 10, "so long at full push without motion: blocked");
  a.field("watchdog_s", watchdog_s, "s", 0.01, 10, "stops so long after the last target");
}

void WallConfig::visit(ConfigArchive& a) {
  a.field("site_m", site_m, "m", 0, 10, "pile and marker, +- in x and y");
  a.field("site_deg", site_deg, "deg", 0, 90, "pile and marker, +- in yaw");
  a.field("stack_m", stack_m, "m", 0, 1, "each stack, +- in x and y");
  a.field("stack_deg", stack_deg, "deg", 0, 45, "each stack, +- in yaw");
  a.field("brick_m", brick_m, "m", 0, 0.2, "each brick on its stack, +- in x and y");
  a.field("brick_deg", brick_deg, "deg", 0, 20, "each brick on its stack, +- in yaw");
  a.field("plate_m", plate_m, "m", 0, 0.1, "plates off-centre, +- in x and y");
  a.field("friction", friction, "", 0.05, 2, "of bricks on anything");
  a.field("freeze", freeze, "bricks at rest far from all that moves cost no physics");
  a.field("thaw_m", thaw_m, "m", 0.05, 5, "nearer to what moves than this they do");
  a.field("support_n", support_n, "N", 0, 1e3, "a planned placement presses no harder");
  a.field("side_n", side_n, "N", 0, 1e3, "a planned placement touches neighbours no harder");
  a.field("blueprint", blueprint, "of the wall that is scored, below resources/; empty: by seed");
  a.field("aerial", aerial, "the aerial robots' bricks lie there too, in one layer");
  a.field("aerial_x_m", aerial_x_m, "m", -1e3, 1e3,
          "beginning of the aerial robots' bricks in map");
  a.field("aerial_y_m", aerial_y_m, "m", -1e3, 1e3,
          "beginning of the aerial robots' bricks in map");
  a.field("aerial_deg", aerial_deg, "deg", -360, 360, "their rows' yaw");
  a.section("magnets", magnets, "force rule of the gripper");
  a.section("storage", storage, "drives of the compartments");
}

}  // namespace kiln::sim
