#pragma once

#include <array>
#include <string>
#include <vector>

#include "robot/scene/fire_site_map.h"
#include "robot/sim/true_wall.h"
#include "robot/sim/world_config.h"

namespace kiln::sim {

/// What a surface is made of; decides what LiDAR, thermal camera, operator camera, physics and
/// water make of it.
enum class Material : std::uint8_t {
  Floor,
  Wall,
  Furniture,
  Table,
  Acrylic,
  Frame,
  Plate,
  Flame,
  Reflection,
  WarmBody,
  WarmPatch,
  Chassis,
  Tank,
  ArmLink,
  ArmJoint,
  Head,
  Hose,
  Wheel,
  Water,
  Obstacle,
  Person,
  BrickRed,
  BrickGreen,
  BrickBlue,
  BrickOrange,
  MarkerMagenta,
  MarkerYellow,
  Storage,
  Magnets,
  Ground  ///< under the open sky: slabs
};

[[nodiscard]] constexpr Material brickMaterial(BrickKind kind) {
  return static_cast<Material>(static_cast<std::uint8_t>(Material::BrickRed) +
                               static_cast<std::uint8_t>(kind));
}

struct SolidBox {
  std::string name;
  Material material = Material::Wall;
  Eigen::Isometry3d X_map_box = Eigen::Isometry3d::Identity();
  Eigen::Vector3d size_m = Eigen::Vector3d::Ones();
  bool solid = true;  ///< false: rays only
  double temperature_c = 25.0;
  bool visible = true;  ///< false: physics only
};

/// A fire place as it truly stands. Frame `front`: centre of the opening, in the outer face of the
/// box, X outward.
struct TrueFirePlace {
  std::string name;
  Eigen::Isometry3d X_map_front = Eigen::Isometry3d::Identity();
  Eigen::Vector3d p_front_plate = Eigen::Vector3d::Zero();
  double box_m = 0.4, plate_m = 0.15;
  double opening_m = 0.15;  ///< diameter
  double rim_m = 0.015;     ///< opaque ring around the opening; acrylic from there to frame_m
  double frame_m = 0.025, acrylic_m = 0.005;
  bool burning = false;
  double reflection_ratio = 0.0;  ///< excess of the mirror image over that of the plate
  std::vector<SolidBox> boxes;    ///< table, frame, acrylic panels
  [[nodiscard]] Eigen::Vector3d plateInMap() const { return X_map_front * p_front_plate; }
};

/// The robot as it truly is: everything that differs from the nominal model.
struct TrueRobot {
  std::array<double, 4> wheel_radius_error{};  ///< relative
  std::array<double, 4> steer_offset_rad{};
  double head_kg = 5.0;
  Eigen::Vector3d p_flange_head = Eigen::Vector3d(0, 0, 0.09);  ///< centre of mass
  Eigen::Isometry3d X_flange_lidar, X_flange_thermal, X_flange_nozzle, X_base_operatorcamera;
  Eigen::Isometry3d X_flange_rgb;
};

/// The world drawn for one seed: scenario.md section 3. Nothing here is ever sent to the robot.
struct TrueArena {
  GroundProfile ground;
  std::vector<SolidBox> ground_boxes;  ///< the same as boxes
  std::vector<SolidBox> boxes;         ///< walls, furniture, distractors
  std::vector<TrueFirePlace> fire_places;
  std::size_t burning = 0;
  TrueWall wall;
  Eigen::Vector3d to_sun = Eigen::Vector3d(-0.42, -0.38, 0.82).normalized();
  TrueRobot robot;
  Pose2 nominal_start;

  /// Footprints of building (all walls together), pile and wall marker, and so much around them, in
  /// map.
  [[nodiscard]] std::vector<Eigen::AlignedBox2d> reducedZones(double around_m) const;
  [[nodiscard]] static TrueArena draw(const WorldConfig& config, const ArenaMap& nominal,
                                      const FireSiteMap& site, const RobotGeometry& robot,
                                      std::uint64_t seed);
  /// Adds the site of the wall. @pre drawn with the same config and seed
  [[nodiscard]] Result<void> addWall(const WorldConfig& config, const WallSiteMap& site,
                                     std::uint64_t seed);
};

/// Where the people put the robot: the nominal start with the error of `count`-th carrying (0 =
/// first start).
[[nodiscard]] Pose2 drawStart(const PerturbationConfig& config, const Pose2& nominal,
                              std::uint64_t seed, std::uint32_t count);

}  // namespace kiln::sim
