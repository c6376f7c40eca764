#pragma once

#include <Eigen/Core>

#include "robot/sim/true_arena.h"

namespace kiln::sim {

/// What the operator's camera makes of a surface. Colours are display values 0 to 255.
struct SurfaceLook {
  Eigen::Vector3f colour = Eigen::Vector3f::Constant(128.0F);
  bool glows = false;  ///< its own light: no shading
};

/// Light of one scene: sun and sky.
struct Daylight {
  Eigen::Vector3f to_sun = Eigen::Vector3f(-0.42F, -0.38F, 0.82F).normalized();
  /// Share of a surface's colour that comes back. @param sunlit 0 (shadow) to 1.
  [[nodiscard]] Eigen::Vector3f strength(const Eigen::Vector3f& normal, float sunlit) const;
  [[nodiscard]] static Eigen::Vector3f sky(const Eigen::Vector3f& direction);
};

/// @param p hit point in map. @param plate_c temperature of the burning plate.
[[nodiscard]] SurfaceLook surfaceLook(Material material, const Eigen::Vector3f& p,
                                      const Eigen::Vector3f& normal, double temperature_c);

/// Names the evenly coloured patch (floor tile, band of a wall) of a surface that p lies in: where
/// all corners of a convex piece share a patch, the piece has one colour. -1: finer than that (a
/// joint between tiles, the flame).
[[nodiscard]] int surfacePatch(Material material, const Eigen::Vector3f& p);

}  // namespace kiln::sim
