#pragma once

#include <string>

#include "robot/sim/true_arena.h"

namespace kiln::sim {

/// Collision bits beside mjcf.cpp's (1 arena, 2 chassis and arm, 4 wheels).
inline constexpr int kBrickBit = 8, kFaceBit = 16;
/// What an awake brick meets; its frozen twin stands like the arena: only what is awake meets it.
inline constexpr int kBrickMeets = 1 | 2 | 4 | kBrickBit | kFaceBit;
inline constexpr int kTwinMeets = 2 | 4 | kFaceBit;

namespace names {
inline constexpr const char* kFace = "head face";          ///< of the magnets
[[nodiscard]] std::string brick(std::size_t index);        ///< body
[[nodiscard]] std::string twin(std::size_t index);         ///< body
[[nodiscard]] std::string grip(std::size_t index);         ///< weld
[[nodiscard]] std::string compartment(std::size_t index);  ///< body, joint, motor
}  // namespace names

/// Parts of the model (mjcf.h) that a world with bricks has, and a robot with a storage.
namespace wall_mjcf {
[[nodiscard]] std::string bricks(const WorldConfig& config, const TrueArena& arena);
/// Within the flange's body: the face of the magnets, 5 mm before the head's box.
[[nodiscard]] std::string face(const WorldConfig& config, const RobotGeometry& robot);
/// Within the base's body.
[[nodiscard]] std::string compartments(const WorldConfig& config, const RobotGeometry& robot);
[[nodiscard]] std::string motors(const RobotGeometry& robot);
/// Welds between flange and brick, all inactive.
[[nodiscard]] std::string grips(const WorldConfig& config, const TrueArena& arena);
}  // namespace wall_mjcf

}  // namespace kiln::sim
