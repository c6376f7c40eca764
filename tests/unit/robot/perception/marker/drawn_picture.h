#pragma once

#include <functional>

#include "common/model/sensor.h"

namespace kiln::testing {

struct Rgb {
  std::uint8_t r, g, b;
};
inline constexpr Rgb kGrey{120, 120, 120}, kMagentaPaint{206, 36, 126}, kYellowPaint{244, 206, 36},
    kRedPaint{190, 32, 36}, kOrangePaint{226, 110, 24};

/// A picture from a function of the pixel.
inline RgbImage draw(const std::function<Rgb(int u, int v)>& colour, int width = 1280,
                     int height = 720) {
  RgbImage out;
  out.frame = "rgb";
  out.width = width;
  out.height = height;
  out.data.reserve(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 3);
  for (int v = 0; v < height; ++v)
    for (int u = 0; u < width; ++u) {
      const Rgb c = colour(u, v);
      out.data.insert(out.data.end(), {c.r, c.g, c.b});
    }
  return out;
}

/// Magenta and yellow squares of `side` pixels.
inline Rgb chequered(int u, int v, int side) {
  return (u / side + v / side) % 2 == 0 ? kMagentaPaint : kYellowPaint;
}

}  // namespace kiln::testing
