#pragma once

#include <vector>

#include "common/model/sensor.h"

namespace kiln::thermal {

/// Temperatures of one frame, row-major, kelvin.
struct KelvinImage {
  int width = 0;
  int height = 0;
  std::vector<float> kelvin;
  [[nodiscard]] float at(int u, int v) const {
    return kelvin[static_cast<std::size_t>(v * width + u)];
  }
  [[nodiscard]] bool inside(int u, int v) const {
    return u >= 0 && v >= 0 && u < width && v < height;
  }
};

/// @pre image.counts has width * height values.
[[nodiscard]] KelvinImage toKelvin(const ThermalImage& image);
/// Mean of each 3 x 3 neighbourhood: one hot pixel is not a source.
[[nodiscard]] KelvinImage smooth3x3(const KelvinImage& image);
/// Median temperature; robust while less than half of the picture is warm.
[[nodiscard]] double medianKelvin(const KelvinImage& image);

}  // namespace kiln::thermal
