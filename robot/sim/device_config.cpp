#include "robot/sim/world_config.h"

namespace kiln::sim {

void BaseDeviceConfig::visit(ConfigArchive& a) {
  a.field("chassis_kg", chassis_kg, "kg", 1, 1000, "without load");
  a.field("electronics_kg", electronics_kg, "kg", 0, 100, "control box of the arm");
  a.field("tank_kg", tank_kg, "kg", 0, 100, "each, with water");
  a.field("wheel_kg", wheel_kg, "kg", 0.1, 50, "each");
  a.field("wheel_width_m", wheel_width_m, "m", 0.01, 0.2, "tread");
  a.field("drive_torque_nm", drive_torque_nm, "Nm", 0.1, 500, "hub motor peak");
  a.field("torque_constant_nm_per_a", torque_constant_nm_per_a, "Nm/A", 0.01, 10, "hub motor");
  a.field("drive_gain", drive_gain, "Nm s/rad", 0, 1e3, "velocity loop");
  a.field("drive_integral_gain", drive_integral_gain, "Nm/rad", 0, 1e4, "velocity loop");
  a.field("rotor_inertia_kgm2", rotor_inertia_kgm2, "kg m2", 0.001, 10,
          "hub motor and steering, at the joint");
  a.field("steer_torque_nm", steer_torque_nm, "Nm", 0.1, 500, "steering drive");
  a.field("steer_gain", steer_gain, "Nm/rad", 0, 1e4, "position loop");
  a.field("steer_damping", steer_damping, "Nm s/rad", 0, 1e3, "position loop");
  a.field("max_speed_mps", max_speed_mps, "m/s", 0.1, 10, "wheel speed limit");
  a.field("watchdog_s", watchdog_s, "s", 0.01, 10, "stop so long after the last setpoint");
  a.field("max_decel_mps2", max_decel_mps2, "m/s2", 0.1, 20, "brakes with, commanded or by itself");
  a.field("wheel_radius_sigma", wheel_radius_sigma, "", 0, 0.1, "relative, per wheel and seed");
  a.field("steer_offset_sigma_deg", steer_offset_sigma_deg, "deg", 0, 10, "per wheel and seed");
  a.field("battery_ah", battery_ah, "Ah", 0.01, 1e3, "full charge; eight lithium cells");
  a.field("battery_charge", battery_charge, "", 0, 1, "share of it at the start");
  a.field("battery_ohm", battery_ohm, "Ohm", 0, 1, "inner resistance");
  a.field("idle_a", idle_a, "A", 0, 100, "computers, controllers and the arm");
  a.field("battery_noise_v", battery_noise_v, "V", 0, 5, "rms, of the measurement");
  a.field("battery_noise_a", battery_noise_a, "A", 0, 50, "rms, of the measurement");
}

void ArmDeviceConfig::visit(ConfigArchive& a) {
  a.field("bandwidth_radps", bandwidth_radps, "rad/s", 1, 120, "of the joint servo");
  a.field("max_torque_nm", max_torque_nm, "Nm", 1, 1e3, "vendor's limits, joints 1 to 6");
  a.field("rotor_inertia_kgm2", rotor_inertia_kgm2, "kg m2", 0.001, 20,
          "at the joint, joints 1 to 6");
  a.field("head_kg", head_kg, "kg", 0.1, 12.5, "end-effector with sensors");
  a.field("head_off_kg", head_off_kg, "kg", 0, 2, "its weight, uniform +-, by seed");
  a.field("head_off_m", head_off_m, "m", 0, 0.1, "its centre of mass, uniform +-, by seed");
  a.field("watchdog_s", watchdog_s, "s", 0.01, 10, "hold so long after the last servo target");
  a.field("hold_decel_radps2", hold_decel_radps2, "rad/s2", 0.1, 100,
          "deceleration of hold and protective stop");
  a.field("protective_force_n", protective_force_n, "N", 1, 1e4,
          "contact force of a protective stop");
  a.field("reduced_force_n", reduced_force_n, "N", 1, 1e4, "the same in a reduced zone");
  a.field("reduced_zone_m", reduced_zone_m, "m", 0, 10, "around the building");
  a.field("force_filter_s", force_filter_s, "s", 0, 1, "time constant of the force measurement");
  a.field("force_noise_n", force_noise_n, "N", 0, 100, "rms a axis");
  a.field("torque_noise_nm", torque_noise_nm, "Nm", 0, 100, "rms a axis");
  a.field("force_offset_n", force_offset_n, "N", 0, 100, "uniform +-, a axis, until it is zeroed");
  a.field("force_drift_n", force_drift_n, "N", 0, 100, "of the force sensor in ten minutes");
  a.field("max_payload_kg", max_payload_kg, "kg", 0.1, 50, "more is refused");
  a.field("speed_tolerance", speed_tolerance, "", 1, 10,
          "refuse targets that need more than this times the limit");
  a.field("position_slack_rad", position_slack_rad, "rad", 0, 1, "jump that is always allowed");
  a.field("carry_grace_s", carry_grace_s, "s", 0, 1,
          "targets under way when people carry the robot are dropped");
}

void WaterConfig::visit(ConfigArchive& a) {
  a.field("tank_l", tank_l, "l", 0, 100, "each of two");
  a.field("flow_lpm", flow_lpm, "l/min", 0.01, 100, "each pump at full duty");
  a.field("flow_spread", flow_spread, "", 0, 0.9, "uniform, relative, per pump and seed");
  a.field("empty_loss", empty_loss, "", 0, 1, "less flow from an empty tank");
  a.field("spin_up_s", spin_up_s, "s", 0.001, 10, "from rest to full flow");
  a.field("watchdog_s", watchdog_s, "s", 0.01, 10,
          "pumps are cut so long after the last heartbeat");
  a.field("running_a", running_a, "A", 0, 100, "at full duty with water");
  a.field("idle_a", idle_a, "A", 0, 100, "at rest");
  a.field("dry_a", dry_a, "A", 0, 100, "dry or blocked");
  a.field("surge_a", surge_a, "A", 0, 100, "more while spinning up");
  a.field("current_noise_a", current_noise_a, "A", 0, 10, "rms");
  a.field("exit_speed_mps", exit_speed_mps, "m/s", 0.1, 50, "both pumps at nominal flow");
  a.field("spread_rms_deg", spread_rms_deg, "deg", 0, 45, "angle to the nozzle axis");
  a.field("drop_ml", drop_ml, "ml", 0.01, 10, "volume of one simulated drop");
  a.field("max_flight_s", max_flight_s, "s", 0.1, 10, "a drop is forgotten after that");
}

void LidarConfig::visit(ConfigArchive& a) {
  a.field("rate_hz", rate_hz, "Hz", 1, 20, "revolutions");
  a.field("columns", columns, "", 16, 3600, "firings a revolution");
  a.field("bias_sigma_m", bias_sigma_m, "m", 0, 1, "per laser, fixed by seed");
  a.field("noise_sigma_m", noise_sigma_m, "m", 0, 1, "white, per point");
  a.field("footprint_mrad", footprint_mrad, "mrad", 0, 50, "full beam divergence");
  a.field("mixing_depth_m", mixing_depth_m, "m", 0, 10, "nearer returns of one beam blur into one");
  a.field("dropout", dropout, "", 0, 1, "lost points");
  a.field("acrylic_return", acrylic_return, "", 0, 1, "rays that acrylic sends back");
  a.field("min_range_m", min_range_m, "m", 0, 10, "nearer hits give no return");
  a.field("max_range_m", max_range_m, "m", 1, 300, "farther hits give no return");
  a.field("chunk_s", chunk_s, "s", 0.001, 0.1,
          "bodies move once a chunk, the sensor with every column");
}

void ThermalConfig::visit(ConfigArchive& a) {
  a.field("rate_hz", rate_hz, "Hz", 0.1, 60, "frames");
  a.field("hfov_deg", hfov_deg, "deg", 10, 120, "horizontal field of view");
  a.field("noise_k", noise_k, "K", 0, 10, "rms, per pixel and frame");
  a.field("fixed_pattern_k", fixed_pattern_k, "K", 0, 10, "rms, per pixel, fixed by seed");
  a.field("blur_px", blur_px, "px", 0, 3, "sigma of the optics");
  a.field("shutter_period_s", shutter_period_s, "s", 1, 1e6, "between shutter calibrations");
  a.field("shutter_spread", shutter_spread, "", 0, 0.9, "uniform, relative");
  a.field("shutter_s", shutter_s, "s", 0, 10, "frozen so long");
  a.field("ambient_c", ambient_c, "degC", -40, 80, "everything that is not warm");
  a.field("acrylic_reflectance", acrylic_reflectance, "", 0, 1,
          "at right angles, long-wave infrared");
}

void CameraConfig::visit(ConfigArchive& a) {
  a.field("rate_hz", rate_hz, "Hz", 0.1, 60, "frames");
  a.field("width", width, "px", 16, 3840, "image");
  a.field("height", height, "px", 16, 2160, "image");
  a.field("hfov_deg", hfov_deg, "deg", 10, 150, "horizontal field of view");
  a.field("noise", noise, "grey levels", 0, 50, "rms");
  a.field("auto_exposure", auto_exposure, "brightness follows what it sees");
}

void SunConfig::visit(ConfigArchive& a) {
  a.field("drawn", drawn, "by seed, in azimuth and elevation");
  a.field("min_elevation_deg", min_elevation_deg, "deg", 1, 90, "lowest by seed");
  a.field("max_elevation_deg", max_elevation_deg, "deg", 1, 90, "highest by seed");
}

void PerturbationConfig::visit(ConfigArchive& a) {
  a.field("fire_box_m", fire_box_m, "m", 0, 1, "fire boxes, +- in x and y");
  a.field("fire_box_deg", fire_box_deg, "deg", 0, 45, "fire boxes, +- in yaw");
  a.field("furniture_m", furniture_m, "m", 0, 1, "furniture, +- in x and y");
  a.field("start_m", start_m, "m", 0, 2, "start pose, +- in x and y");
  a.field("start_deg", start_deg, "deg", 0, 45, "start pose, +- in yaw");
  a.field("size_m", size_m, "m", 0, 0.1, "every box, +- a side");
  a.field("plate_off_centre_m", plate_off_centre_m, "m", 0, 0.1, "plates, +- in the plane");
  a.field("extrinsic_m", extrinsic_m, "m", 0, 0.1, "sensor and nozzle mounts, sigma an axis");
  a.field("extrinsic_deg", extrinsic_deg, "deg", 0, 10, "sensor and nozzle mounts, sigma an axis");
  a.field("slope_deg", slope_deg, "deg", 0, 5, "ramp before the door, +-");
  a.field("edge_m", edge_m, "m", 0, 0.02, "edge before the door, +- in height");
  a.field("rounding_m", rounding_m, "m", 0, 0.05, "radius of the edges of boxes");
}

void FireConfig::visit(ConfigArchive& a) {
  a.field("ambient_c", ambient_c, "degC", -40, 80, "plate before it is lit");
  a.field("rise_k", rise_k, "K", 0, 1000, "plate: ambient + rise (1 - exp(-t / time constant))");
  a.field("time_constant_s", time_constant_s, "s", 0.1, 1e4, "of the plate");
  a.field("lit_at_start", lit_at_start, "with the world's time, not with the mission's clock");
  a.field("flame_c", flame_c, "degC", -40, 500, "moving silk");
  a.field("reflection_min_c", reflection_min_c, "degC", -40, 500,
          "mirror image of the hot plate, coolest by seed");
  a.field("reflection_max_c", reflection_max_c, "degC", -40, 500,
          "mirror image of the hot plate, warmest by seed");
  a.field("acrylic_thickness_m", acrylic_thickness_m, "m", 0.001, 0.05, "panels of the fire box");
  a.field("frame_m", frame_m, "m", 0.005, 0.1, "opaque edges of the fire box");
  a.field("full_score_l", full_score_l, "l", 0.01, 100, "more water gives no more points");
  a.field("points", points, "", 0, 1e3, "for the burning place at full score");
}

}  // namespace kiln::sim
