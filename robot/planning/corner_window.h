#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace kiln {

/// Half widths, in samples, of a sliding mean that rounds the corners of a polyline: `wanted` at
/// most, never beyond the middle of a line (so that each line keeps a straight part or at least its
/// direction), none at both ends.
/// @param corners  sample indices of the corners, ascending; the ends of the polyline are added.
[[nodiscard]] inline std::vector<std::size_t> cornerWindows(std::size_t samples,
                                                            std::vector<std::size_t> corners,
                                                            std::size_t wanted) {
  std::vector<std::size_t> window(samples, 0);
  if (samples < 3) return window;
  corners.insert(corners.begin(), 0);
  if (corners.back() != samples - 1) corners.push_back(samples - 1);
  for (std::size_t c = 1; c + 1 < corners.size(); ++c) {
    const std::size_t before = (corners[c] - corners[c - 1]) / 2;
    const std::size_t after = (corners[c + 1] - corners[c]) / 2;
    const std::size_t half = std::min({wanted, before, after});
    // Outside of this reach the mean of a straight line is the line itself.
    for (std::size_t k = corners[c] - half; k <= corners[c] + half; ++k) window[k] = half;
  }
  return window;
}

}  // namespace kiln
