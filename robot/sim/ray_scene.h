#pragma once

#include <array>
#include <optional>
#include <vector>

#include "robot/scene/raycaster.h"
#include "robot/sim/scene_state.h"
#include "robot/sim/true_arena.h"

namespace kiln::sim {

/// Which rays meet what.
namespace mask {
inline constexpr std::uint32_t kSolid = 1;  ///< arena, everything opaque
inline constexpr std::uint32_t kRobot = 2;
inline constexpr std::uint32_t kAcrylic = 4;  ///< blocks infrared and water; LiDAR and light pass
inline constexpr std::uint32_t kWarmPatch =
    8;  ///< warm places that have no shape of their own: infrared only
inline constexpr std::uint32_t kSilk =
    16;  ///< the moving flame: light, infrared and LiDAR, not water
inline constexpr std::uint32_t kLightOnly = 32;      ///< water drops
inline constexpr std::uint32_t kGripper = 64;        ///< the thermal camera looks out of it
inline constexpr std::uint32_t kLidarHousing = 128;  ///< the LiDAR turns inside it
inline constexpr std::uint32_t kBoard = 256;         ///< boards before the LiDAR alone
inline constexpr std::uint32_t kLidar = kSolid | kRobot | kSilk | kGripper | kBoard;
inline constexpr std::uint32_t kThermal =
    kSolid | kRobot | kAcrylic | kWarmPatch | kSilk | kLidarHousing;
inline constexpr std::uint32_t kColour =
    kSolid | kRobot | kSilk | kLightOnly | kGripper | kLidarHousing;
inline constexpr std::uint32_t kWater = kSolid | kAcrylic;
}  // namespace mask

/// The true world as shapes for rays. update() moves what moves. One for each thread that casts
/// rays.
class RayScene {
 public:
  /// @param with_drops for cameras of visible light: water in flight costs time at every update.
  RayScene(const WorldConfig& config, const TrueArena& arena, const RobotGeometry& robot,
           bool with_drops);
  void update(const SceneState& state);
  [[nodiscard]] const Raycaster& rays() const { return rays_; }
  [[nodiscard]] static Material material(const Raycaster::Hit& hit) {
    return static_cast<Material>(hit.material);
  }
  /// Which of TrueArena::boxes was hit, if any.
  [[nodiscard]] std::optional<std::size_t> box(const Raycaster::Hit& hit) const;
  /// Of a surface, apart from mirror images; degrees Celsius.
  [[nodiscard]] double temperature(const Raycaster::Hit& hit) const {
    return temperature_c_[hit.instance];
  }

 private:
  struct Moving {
    Raycaster::Id id;
    int link;  ///< 0 base, 1..6 arm frames (6 = flange)
    Eigen::Isometry3d X_link_shape;
  };
  Raycaster::Id note(Raycaster::Id id, double temperature_c);
  void addArena(const TrueArena& arena);
  Raycaster::Id addSolid(const SolidBox& box);
  void addFirePlace(const TrueFirePlace& place);
  void addFront(const TrueFirePlace& place);
  void addRobot(const TrueArena& arena);
  void addCapsule(int link, const Eigen::Vector3d& from, const Eigen::Vector3d& to, double radius,
                  Material material);
  void addWheels();
  void addBricks(const TrueArena& arena);
  void addStorage(bool face);
  void updateFire(const SceneState& state);
  void updateRobot(const SceneState& state);
  void addDisturbances(const WorldConfig& config);
  void updateDisturbances(const SceneState& state);
  void updateBricks(const SceneState& state);

  Raycaster rays_;
  RobotGeometry robot_;
  FireConfig fire_;
  double rounding_m_;
  std::vector<Moving> moving_;
  std::array<Raycaster::Id, 4> wheels_{};
  std::vector<double> temperature_c_;                             ///< by instance
  Eigen::Isometry3d X_map_fire_ = Eigen::Isometry3d::Identity();  ///< burning place, frame `front`
  Eigen::Vector3d p_front_plate_ = Eigen::Vector3d::Zero();
  double plate_m_ = 0.15, reflection_ratio_ = 0.0;
  std::vector<Raycaster::Id> flame_;
  std::vector<Raycaster::Id> burning_plate_, reflection_;
  std::vector<Raycaster::Id> drops_;
  std::size_t drops_shown_ = 0;
  Eigen::Isometry3d X_flange_lidar_ = Eigen::Isometry3d::Identity();
  std::vector<Raycaster::Id> boxes_;  ///< as TrueArena::boxes
  std::vector<Eigen::Isometry3d> X_map_boxes_;
  std::optional<std::size_t> moved_;  ///< of boxes_
  struct Person {
    Raycaster::Id body, hip, head;
  };
  std::vector<Person> people_;
  std::size_t people_shown_ = 0;
  std::vector<Raycaster::Id> boards_;
  bool boards_shown_ = false;
  std::vector<Raycaster::Id> bricks_;
  std::vector<Eigen::Isometry3d> X_map_bricks_;  ///< as they stand in rays_
  struct StoragePart {
    Raycaster::Id id;
    std::size_t compartment;
    Eigen::Isometry3d X_compartment_box;
  };
  std::vector<StoragePart> storage_;
  bool obstacle_shown_ = false;
  Raycaster::Id obstacle_ = 0;
};

}  // namespace kiln::sim
