#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <Eigen/Geometry>

#include "common/config/config_archive.h"
#include "robot/scene/brick.h"

namespace kiln {

/// A brick as it is thought to lie. Which frame all poses of a world share is the caller's choice.
struct ModelBrick {
  int id = 0;  ///< the caller's
  BrickKind kind = BrickKind::Red;
  Eigen::Isometry3d X_world_brick = Eigen::Isometry3d::Identity();
};

/// A rectangle of ground: X and Y of its pose span it, Z is up.
struct GroundPatch {
  Eigen::Isometry3d X_world_ground = Eigen::Isometry3d::Identity();
  double half_x_m = 3.0, half_y_m = 3.0;
};

/// The parametrised world that a model cloud is made of.
struct ModelWorld {
  std::vector<ModelBrick> bricks;
  std::optional<GroundPatch> ground;
  std::vector<Eigen::Vector3d> sensors;  ///< what any of these sees is visible; not empty
};

/// A piece of a visible surface.
struct ModelPoint {
  static constexpr int kGround = -1;
  Eigen::Vector3f p = Eigen::Vector3f::Zero();
  Eigen::Vector3f n = Eigen::Vector3f::UnitZ();  ///< unit, outward; exact
  int brick = kGround;                           ///< index into ModelWorld::bricks
  std::uint8_t face = 0;                         ///< of a brick: see FaceGrid
};

/// The lattice of one face. Faces 0..5 of a brick: -X +X -Y +Y -Z +Z; u and v are the two other
/// axes in ascending order. Cell (i, j) has its centre at ((i + 0.5) / nu - 0.5) of the length
/// along u, likewise v.
struct FaceGrid {
  int nu = 0, nv = 0;
  std::vector<std::uint8_t> visible;  ///< nu * nv, u fastest
  [[nodiscard]] std::size_t cell(int i, int j) const {
    return static_cast<std::size_t>(j) * static_cast<std::size_t>(nu) + static_cast<std::size_t>(i);
  }
};

struct ModelCloud {
  std::vector<ModelPoint> points;                ///< brick by brick, the ground last
  std::vector<std::array<FaceGrid, 6>> lattice;  ///< by brick: which cells are in sight
  [[nodiscard]] int visibleOf(std::size_t brick) const;
};

/// Turns a parametrised world into the points that a LiDAR can see of it: the faces that look
/// towards a sensor on a lattice of `spacing_m`, each point asked by one ray whether something
/// stands before it (NimbRo UGV paper, "Rendering and Sampling", which renders 2800 x 2800 pixels
/// and thins them). Exact normals, and the brick of every point.
/// Confined to one thread. Keeps the shapes of the last world, so that the same bricks elsewhere
/// cost no new scene. Cost: tests/bench/bricks_bench.
class ModelCloudGenerator {
 public:
  struct Config {
    double spacing_m = 0.02;
    double min_cosine = 0.05;  ///< of the view with the normal; flatter surfaces give no returns
    void visit(ConfigArchive& a);
  };
  explicit ModelCloudGenerator(const Config& config);
  ~ModelCloudGenerator();
  ModelCloudGenerator(ModelCloudGenerator&&) noexcept;
  ModelCloudGenerator& operator=(ModelCloudGenerator&&) noexcept;

  /// @pre world.sensors is not empty.
  [[nodiscard]] ModelCloud generate(const ModelWorld& world);
  [[nodiscard]] const Config& config() const { return config_; }

 private:
  struct Scene;
  Config config_;
  std::unique_ptr<Scene> scene_;
};

/// Lengths of a brick along its axes, nominal.
[[nodiscard]] inline Eigen::Vector3d brickSize(BrickKind kind) {
  return {brickShape(kind).length_m, kBrickSide_m, kBrickSide_m};
}

/// One point a cube of edge `leaf_m` and brick: the mean of its points, the normal of most of them.
/// @pre leaf_m > 0; points within +-2^15 leaves of the origin.
[[nodiscard]] std::vector<ModelPoint> voxelised(std::span<const ModelPoint> points, double leaf_m);

}  // namespace kiln
