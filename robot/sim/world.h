#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/model/sensor.h"
#include "robot/hal/arm.h"
#include "robot/hal/device_set.h"
#include "robot/hal/drive_base.h"
#include "robot/hal/gripper.h"
#include "robot/hal/storage.h"
#include "robot/sim/colour_camera.h"
#include "robot/sim/jet_profile.h"
#include "robot/sim/scene_state.h"
#include "robot/sim/true_arena.h"
#include "robot/sim/wall_part.h"

namespace kiln::sim {

/// Which sensors run; one that does not run costs nothing.
struct SensorRequest {
  bool lidar = false, thermal = false, operator_camera = false, head_camera = false;
};

/// Any subset of commands; an absent one lets that device's watchdog count on.
struct WorldCommands {
  std::optional<ArmServo> arm;
  std::optional<Stamp> arm_sent;  ///< by the sender's clock
  std::optional<WheelCommands> base;
  std::optional<std::array<double, 2>> pumps;
  std::optional<MagnetMask> magnets;
  std::optional<std::vector<double>> storage;  ///< targets, m
  std::optional<SensorRequest> sensors;
  std::optional<ArmPayload> payload;
  bool zero_force = false;
  bool release_protective_stop = false;
  bool request_reset = false;
  bool start_clock = false;  ///< of the mission; the first one counts
};

/// What the devices report, and the sensor frames finished since the last report. No truth.
struct WorldReport {
  Stamp now;
  std::uint64_t seq = 0;
  ArmState arm;
  BaseState base;
  PumpsState pumps;
  std::optional<GripperState> gripper;  ///< of a world with bricks
  std::optional<StorageState> storage;  ///< of a robot that has one
  std::vector<PointCloudPtr> lidar;
  std::vector<ThermalImagePtr> thermal;
  std::vector<RgbImagePtr> colour;  ///< of both cameras, told apart by their frame
  std::uint32_t resets = 0;
  std::string refused;
  Duration slipped{};  ///< how long the world's clock has waited for a slow machine, in total
};

struct Collision {
  Stamp time;
  std::string a, b;      ///< a on the robot, or what it holds
  double force_n = 0.0;  ///< the most while they touched
};

/// What truly happened at the fire places.
struct FireTruth {
  std::vector<double> litres_delivered;  ///< by place, as in TrueArena::fire_places
  std::size_t burning = 0;
  double pump_on_s = 0.0, litres_emitted = 0.0;
  std::vector<JetProfile::Row> jet_profile;
  std::array<double, 2> tank_l{}, full_flow_lpm{};
  Eigen::Isometry3d X_map_nozzle = Eigen::Isometry3d::Identity();
  bool jet_on = false;
  double plate_c = 25.0;
};

/// What truly happened; for referees and evaluation, never for the robot.
struct Truth {
  std::uint64_t seed = 0;
  std::string world;
  Stamp now;
  std::vector<Collision> collisions;
  std::uint32_t resets = 0;
  double score = 0.0;
  Eigen::Isometry3d X_map_base, X_map_thermal;
  Vector6d q;
  FireTruth fire;
  WallTruth wall;
  std::vector<Pose2> starts;   ///< after each carrying, the first one included
  std::vector<Pose2> kidnaps;  ///< where the robot was put without anybody saying so
  std::vector<Eigen::Vector3d> people;
  std::optional<Stamp> fell;  ///< the base first lay on its side, or below the ground
  TrueArena arena;
};

/// The world in one process and on one thread: physics, devices, sensors, water, faults, truth.
/// Time moves only in advance(). Same config, seed and commands: the same reports, bit for bit.
/// Thread-compatible.
class World {
 public:
  struct Options {
    /// false: somebody else renders what colourDue() hands out (real time, a thread of its own).
    bool render_colour = true;
  };
  /// Reads arena and robot from resources/. Errors are one clear sentence.
  [[nodiscard]] static Result<std::unique_ptr<World>> create(const WorldConfig& config,
                                                             std::uint64_t seed, Options options);
  [[nodiscard]] static Result<std::unique_ptr<World>> create(const WorldConfig& config,
                                                             std::uint64_t seed) {
    return create(config, seed, Options{});
  }
  ~World();

  void command(const WorldCommands& commands);
  /// Steps to the last whole physics step not after `until`. @pre until >= now().
  [[nodiscard]] WorldReport advance(Stamp until);
  [[nodiscard]] Stamp now() const;
  [[nodiscard]] Truth truth() const;
  /// The scene of a colour camera's frame that became due in the last advance(), if nobody
  /// rendered it.
  [[nodiscard]] std::optional<SceneState> colourDue(CameraMount camera = CameraMount::Mast);
  /// Beside arm and base: what the robot of this world has.
  [[nodiscard]] DeviceSet devices() const;
  /// For tests and figures: bricks that physics moves now.
  [[nodiscard]] std::size_t awakeBricks() const;
  [[nodiscard]] std::uint64_t seed() const;
  [[nodiscard]] const WorldConfig& config() const;
  [[nodiscard]] const TrueArena& arena() const;
  [[nodiscard]] const RobotGeometry& robot() const;

 private:
  struct Impl;
  explicit World(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace kiln::sim
