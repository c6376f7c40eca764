#pragma once

#include <vector>

#include "robot/perception/thermal/kelvin_image.h"

namespace kiln::thermal {

/// One hill of the temperature landscape.
struct Segment {
  double peak_k = 0.0;
  std::vector<int> pixels;  ///< indices v * width + u, warmest first
};

struct Segmentation {
  std::vector<Segment> segments;  ///< warmest first
  std::vector<int> label;         ///< per pixel: index of its segment, -1 below the floor
};

struct SegmenterLimits {
  double background_k = 0.0;
  double floor_k = 0.0;     ///< pixels cooler than this belong to nothing
  double min_peak_k = 0.0;  ///< cooler hills are dropped
  double min_prominence_k = 0.4;
};

/// Watershed from the warmest pixel downwards, 8-connected. Two hills that meet stay apart if the
/// saddle lies below half of the warmer one's excess over the background and the cooler one rises
/// by min_prominence_k above it; so a hot object and its reflection in the table come out as two, a
/// noisy plateau as one.
[[nodiscard]] Segmentation segmentHills(const KelvinImage& image, const SegmenterLimits& limits);

}  // namespace kiln::thermal
