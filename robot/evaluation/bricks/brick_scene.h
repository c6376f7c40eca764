#pragma once

#include <cstdint>
#include <random>
#include <vector>

#include <Eigen/Geometry>

#include "robot/perception/bricks/rough_pose.h"

namespace kiln {

/// What became of a brick of the database.
enum class BrickFate : std::uint8_t { InPlace, Missing, Fallen, Tilted };

/// A brick that is there. World frame: on the ground, Z up.
struct TrueBrick {
  int id = 0;
  BrickKind kind = BrickKind::Red;
  BrickFate fate = BrickFate::InPlace;
  Eigen::Isometry3d X_world_brick = Eigen::Isometry3d::Identity();
  Eigen::Vector3d size_m = Eigen::Vector3d::Zero();  ///< nominal +-2 mm
};

/// A pile or wall as it truly is, and as the robot's database has it.
struct BrickScene {
  std::vector<TrueBrick> bricks;
  std::vector<TargetBrick> database;  ///< nominal, in the target's frame
  std::vector<BrickFate> fates;       ///< of the database's bricks
  bool wall = false;
  Eigen::Isometry3d X_world_target = Eigen::Isometry3d::Identity();
  [[nodiscard]] const TrueBrick* find(int id) const;
};

using SceneRandom = std::mt19937_64;

/// The pile of the arena or of the lab with the errors of scenario.md section 4: each stack off by
/// up to 5 cm and 10 deg, each brick on its stack by up to 1 cm and 1.5 deg, sizes +-2 mm.
[[nodiscard]] BrickScene makePileScene(bool lab, SceneRandom& random);
/// A wall that is built as far as some brick: joints that came out wider than planned, each brick off
/// by N(0, 4 mm, 0.5 deg). @param bricks  placed, in the order of the layers
[[nodiscard]] BrickScene makeWallScene(std::size_t bricks, SceneRandom& random);

/// Takes away, throws down beside the target or leans over some of the bricks on which nothing
/// lies. @param share  of those.
void disturb(BrickScene& scene, double share, SceneRandom& random);

}  // namespace kiln
