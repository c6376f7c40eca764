#pragma once

#include <cmath>
#include <numbers>

namespace kiln {

/// Angle of (x, y) about Z in [-pi, pi], within 2e-5 rad: for sorting tens of thousands of points
/// into bins, where std::atan2 is what costs most. (0, 0) gives 0; NaN gives NaN.
/// Source: Abramowitz and Stegun, Handbook of Mathematical Functions, 4.4.47.
[[nodiscard]] inline float bearing(float y, float x) {
  const float ax = std::fabs(x), ay = std::fabs(y);
  const bool steep = ay > ax;
  const float longer = steep ? ay : ax;
  if (longer == 0.0F) return 0.0F;
  const float t = (steep ? ax : ay) / longer, t2 = t * t;
  const float first_octant =
      t *
      (0.9998660F + t2 * (-0.3302995F + t2 * (0.1801410F + t2 * (-0.0851330F + t2 * 0.0208351F))));
  constexpr float kPi = std::numbers::pi_v<float>;
  const float first_quadrant = steep ? 0.5F * kPi - first_octant : first_octant;
  return std::copysign(x < 0.0F ? kPi - first_quadrant : first_quadrant, y);
}

}  // namespace kiln
