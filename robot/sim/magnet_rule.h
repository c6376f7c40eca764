#pragma once

#include <array>

#include "robot/hal/gripper.h"
#include "robot/sim/true_wall.h"

namespace kiln::sim {

/// Share of a pole that lies over the brick's plates, 0 to 1. @param p_brick its middle, in the
/// brick's upper side
[[nodiscard]] double plateShare(const TrueBrick& brick, const Eigen::Vector2d& p_brick,
                                double radius_m);

/// Pull of one magnet in N. @param field 0 (off) to 1, @param gap_m to the steel, <= 0: touching.
/// Falls with the square of the distance, to a half at half_gap_m.
[[nodiscard]] double magnetPull(const MagnetConfig& config, double field, double share,
                                double gap_m);

/// What a brick does to the face that holds it: force and torque about the middle of the face, in
/// `tool` (Z from the face to the brick: weight that hangs is +Z).
struct GripLoad {
  Eigen::Vector3d force_n = Eigen::Vector3d::Zero(), torque_nm = Eigen::Vector3d::Zero();
};

/// The eight magnets on one brick, as they are now.
struct MagnetTouch {
  std::array<double, kMagnets> pull_n{}, gap_m{};
  std::array<double, kMagnets> share{};
  [[nodiscard]] double pull() const;
};

enum class GripVerdict { Holds, Slips, ComesOff };

/// The force rule: the face keeps its brick while the pull is greater than what pulls away and the
/// pressure between both stays within the poles that touch (else it tips off over an edge), and the
/// brick does not slide while shear and twist together stay below friction on that pressure
/// (shear_n at the pull of flush_n).
[[nodiscard]] GripVerdict judgeGrip(const MagnetConfig& config, const MagnetTouch& touch,
                                    const GripLoad& load);

}  // namespace kiln::sim
