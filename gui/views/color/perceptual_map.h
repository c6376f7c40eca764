#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace kiln::gui {

/// 8-bit sRGB.
struct Rgb {
  std::uint8_t r = 0, g = 0, b = 0;
  friend bool operator==(const Rgb&, const Rgb&) = default;
};

[[nodiscard]] constexpr Rgb rgbFromHex(std::uint32_t hex) {
  return {static_cast<std::uint8_t>(hex >> 16), static_cast<std::uint8_t>(hex >> 8),
          static_cast<std::uint8_t>(hex)};
}
/// (1 - s) a + s b, s clamped to 0..1.
[[nodiscard]] Rgb mix(Rgb a, Rgb b, double s);
/// Moves a colour towards the grey of its own lightness; 1 = no colour left.
[[nodiscard]] Rgb desaturate(Rgb color, double amount);
/// Perceived lightness in OKLab, 0..1 (B. Ottosson, "A perceptual color space for image
/// processing").
[[nodiscard]] double lightness(Rgb color);

/// 256 colours whose perceived lightness rises by equal steps, so that equal differences of the
/// value look equal and a grey print still reads right. Built from anchors in OKLab (lightness by
/// position, hue and chroma by anchor).
class PerceptualMap {
 public:
  struct Anchor {
    double at = 0.0;       ///< 0..1, ascending
    double chroma = 0.0;   ///< OKLCh
    double hue_deg = 0.0;  ///< OKLCh
  };
  /// @pre anchors are ascending, first at 0 and last at 1.
  PerceptualMap(double lightness_low, double lightness_high, const std::vector<Anchor>& anchors);

  /// Black-violet over red and orange to pale yellow: temperatures.
  [[nodiscard]] static PerceptualMap heat();
  /// Blue over teal to yellow-green, for points on a dark or on a light ground.
  [[nodiscard]] static PerceptualMap height(bool dark_ground);

  /// @param t clamped to 0..1; NaN gives the lowest colour.
  [[nodiscard]] Rgb at(double t) const;
  [[nodiscard]] const std::array<Rgb, 256>& table() const { return table_; }

 private:
  std::array<Rgb, 256> table_{};
};

}  // namespace kiln::gui
