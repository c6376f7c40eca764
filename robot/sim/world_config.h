#pragma once

#include <string>
#include <vector>

#include "common/geom/camera_model.h"
#include "common/robot_model/robot_geometry.h"
#include "robot/sim/wall_config.h"

namespace kiln::sim {

/// Rigid bodies and contacts (simulation.md section 1: stiff contacts, Newton, pyramidal, 4 ms).
struct PhysicsConfig {
  double step_s = 0.004;
  double contact_slack_s = 0.001;  ///< solref time constant = 2 step + this
  double friction = 0.9;           ///< wheels, walls and furniture, sliding
  void visit(ConfigArchive& a);
};

/// Hub wheels, steering drives, masses and the base's own fail-safe.
struct BaseDeviceConfig {
  double chassis_kg = 90.0;      ///< without load
  double electronics_kg = 14.0;  ///< control box of the arm
  double tank_kg = 6.0;          ///< each, with water
  double wheel_kg = 3.0;
  double wheel_width_m = 0.05;
  double drive_torque_nm = 18.0;           ///< hub motor peak
  double torque_constant_nm_per_a = 0.52;  ///< 8.27 / KV, KV 16
  double drive_gain = 10.0;                ///< Nm per rad/s
  double drive_integral_gain = 60.0;       ///< Nm per rad
  double rotor_inertia_kgm2 = 0.05;        ///< hub motor and steering, at the joint
  double steer_torque_nm = 40.0;
  double steer_gain = 800.0;    ///< Nm per rad
  double steer_damping = 15.0;  ///< Nm per rad/s
  double max_speed_mps = 4.0;
  double watchdog_s = 0.25;           ///< stop so long after the last setpoint
  double max_decel_mps2 = 2.0;        ///< of the wheels, commanded or by itself
  double wheel_radius_sigma = 0.005;  ///< relative, per wheel
  double steer_offset_sigma_deg = 0.3;
  double battery_ah = 20.0, battery_ohm = 0.05;
  double battery_charge = 1.0;  ///< share of it at the start
  double idle_a = 15.0;         ///< computers, controllers, the arm: about an hour
  double battery_noise_v = 0.02, battery_noise_a = 0.1;
  void visit(ConfigArchive& a);
};

/// The arm's controller: joint servo, brakes, force sensor.
struct ArmDeviceConfig {
  double bandwidth_radps = 50.0;                                 ///< of the joint servo
  std::vector<double> max_torque_nm{330, 330, 150, 54, 54, 54};  ///< vendor
  std::vector<double> rotor_inertia_kgm2{2.0, 2.0, 1.0,
                                         0.2, 0.2, 0.2};  ///< at the joint, estimated
  double head_kg = 5.0;                                   ///< end-effector with sensors
  double head_off_kg = 0.1, head_off_m = 0.005;           ///< uniform, +-, by seed
  double watchdog_s = 0.2;
  double hold_decel_radps2 = 10.0;  ///< decelerates and holds
  double protective_force_n = 150.0;
  double reduced_force_n = 100.0;  ///< instead, in a reduced zone
  double reduced_zone_m = 1.0;     ///< around the building
  double force_filter_s = 0.02;    ///< of the force measurement
  double force_noise_n = 1.0, torque_noise_nm = 0.05;
  double force_offset_n = 5.0;   ///< uniform, +-, per axis and seed: before it is zeroed
  double force_drift_n = 2.0;    ///< in ten minutes, in a direction by seed
  double max_payload_kg = 12.5;  ///< vendor; more is refused
  double speed_tolerance =
      1.2;  ///< a target that needs more than this times the speed limit is refused
  double position_slack_rad = 0.02;  ///< jump that is always allowed
  double carry_grace_s = 0.05;       ///< targets under way when people carry the robot are dropped
  void visit(ConfigArchive& a);
};

/// Water: scenario.md section 2. No flow or level is ever reported, only current.
struct WaterConfig {
  double tank_l = 5.0;
  double flow_lpm = 1.6;      ///< each pump
  double flow_spread = 0.10;  ///< uniform, relative, per pump
  double empty_loss = 0.20;   ///< less flow from an empty tank
  double spin_up_s = 0.4;
  double watchdog_s = 0.2;
  double running_a = 3.0, idle_a = 0.0, dry_a = 0.6, surge_a = 1.5, current_noise_a = 0.05;
  double exit_speed_mps = 6.0;  ///< both pumps at nominal flow
  double spread_rms_deg = 2.0;  ///< angle to the nozzle axis
  double drop_ml = 0.25;        ///< volume of one simulated drop
  double max_flight_s = 1.5;
  void visit(ConfigArchive& a);
};

struct LidarConfig {
  double rate_hz = 10.0;
  int columns = 1800;
  double bias_sigma_m = 0.010;  ///< per laser, fixed by seed
  double noise_sigma_m = 0.010;
  double footprint_mrad = 3.0;  ///< full beam divergence: mixed pixels at edges
  double mixing_depth_m = 0.6;  ///< returns nearer than this to each other blur into one
  double dropout = 0.005;
  double acrylic_return = 0.03;
  double min_range_m = 0.4, max_range_m = 100.0;
  double chunk_s = 0.020;  ///< bodies move once a chunk, the sensor with every column
  void visit(ConfigArchive& a);
};

struct ThermalConfig {
  double rate_hz = 8.77;
  double hfov_deg = 57.0;
  double noise_k = 0.050;
  double fixed_pattern_k = 0.3;
  double blur_px = 0.5;  ///< sigma of the optics
  double shutter_period_s = 180.0;
  double shutter_spread = 0.15;  ///< uniform, relative
  double shutter_s = 0.6;
  double ambient_c = 25.0;
  double acrylic_reflectance = 0.05;  ///< at right angles; Schlick towards grazing
  void visit(ConfigArchive& a);
};

struct CameraConfig {
  double rate_hz = 10.0;
  int width = 1280, height = 720;
  double hfov_deg = 78.0;
  double noise = 2.0;  ///< grey levels
  bool auto_exposure = false;
  void visit(ConfigArchive& a);
  /// The head's Brio, with an exposure of its own.
  [[nodiscard]] static CameraConfig head() {
    return {10.0, 1280, 720, kHeadCameraHfov_deg, 2.0, true};
  }
};

/// Where the sun stands; above the horizon.
struct SunConfig {
  bool drawn = false;  ///< by seed; false: it stands where it always stood
  double min_elevation_deg = 15.0, max_elevation_deg = 70.0;
  void visit(ConfigArchive& a);
};

/// What differs between the true world and the configured one, drawn by seed (scenario.md sections
/// 1 to 3).
struct PerturbationConfig {
  double fire_box_m = 0.10, fire_box_deg = 5.0;     ///< uniform, +-
  double furniture_m = 0.15;                        ///< uniform, +-
  double start_m = 0.20, start_deg = 5.0;           ///< uniform, +-
  double size_m = 0.002;                            ///< uniform, +-, of every box
  double plate_off_centre_m = 0.003;                ///< uniform, +-
  double extrinsic_m = 0.005, extrinsic_deg = 0.3;  ///< sigma per axis
  double slope_deg = 0.5, edge_m = 0.005;           ///< ramp and edge before the door, uniform, +-
  double rounding_m = 0.005;                        ///< radius of the edges of boxes, for rays
  void visit(ConfigArchive& a);
};

struct FireConfig {
  double ambient_c = 25.0, rise_k = 105.0,
         time_constant_s = 60.0;  ///< T = ambient + rise (1 - exp(-t / constant))
  bool lit_at_start = false;      ///< of the world, instead of the mission's clock
  double flame_c = 38.0;
  double reflection_min_c = 45.0,
         reflection_max_c = 70.0;  ///< mirror image of the hot plate in the acrylic
  double acrylic_thickness_m = 0.005, frame_m = 0.025;
  double full_score_l = 1.0, points = 6.0;
  void visit(ConfigArchive& a);
};

/// A warm thing that is not the fire; its temperature is drawn by seed.
struct DistractorConfig {
  std::string name;
  PoseConfig center;
  std::vector<double> size_m{0.2, 0.2, 0.2};
  double min_c = 45.0, max_c = 70.0;
  bool solid = true;  ///< false: a warm patch on a surface, thermal camera only
  void visit(ConfigArchive& a);
};

/// A wall of the arena that is heated, and on which an infrared camera sees where water landed.
struct WarmBoardConfig {
  std::string box;                    ///< name of a wall of the arena
  double min_c = 45.0, max_c = 50.0;  ///< drawn by seed
  double water_c = 15.0;
  double share = 0.004;        ///< of the way to the water's temperature, by one drop
  double splash_m = 0.008;     ///< radius that a drop wets
  double warm_again_s = 20.0;  ///< time constant
  double cell_m = 0.005;
  void visit(ConfigArchive& a);
};

/// A scripted fault; the kinds and their numbers: fault_catalog.h.
struct FaultConfig {
  std::string name;
  double at_s = 0.0;
  double duration_s = 1e9;
  std::vector<double> values;
  void visit(ConfigArchive& a);
  /// "NAME[=VALUE,...]@T[:DURATION]", seconds. Error names the known faults.
  [[nodiscard]] static Result<FaultConfig> parse(const std::string& text);
};

/// Every constant of the world (resources/worlds/*.yaml; scenario.md holds the reasons).
struct WorldConfig {
  std::string name = "fire";
  std::string arena = "config/arena_kitchen.yaml";  ///< below resources/
  std::string robot = "robot_model/bob.yaml";       ///< below resources/
  std::string
      without;  ///< devices that its robot lacks, as kiln-sim --without; separated by spaces
  bool approach = false;  ///< ramp and edge of the arena; false: the ground is flat, z = 0
  double device_period_s = 0.008;
  PhysicsConfig physics;
  BaseDeviceConfig base;
  ArmDeviceConfig arm;
  WaterConfig water;
  LidarConfig lidar;
  ThermalConfig thermal;
  CameraConfig camera;
  CameraConfig head_camera = CameraConfig::head();
  SunConfig sun;
  PerturbationConfig perturbation;
  FireConfig fire;
  WallConfig wall;
  double collision_force_n = 5.0;
  std::vector<DistractorConfig> distractors;
  std::vector<WarmBoardConfig> warm_boards;
  std::vector<FaultConfig> faults;
  void visit(ConfigArchive& a);
  [[nodiscard]] Result<void> validate() const;
  /// Reads and validates; errors carry file and line.
  [[nodiscard]] static Result<WorldConfig> load(const std::string& path);
};

}  // namespace kiln::sim
