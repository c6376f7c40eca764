#pragma once

#include <QImage>
#include <optional>

#include "common/model/sensor.h"
#include "gui/views/color/perceptual_map.h"

namespace kiln::gui {

/// The temperatures at the two ends of the colour map, degrees Celsius.
struct ThermalScale {
  double low_c = 20.0;
  double high_c = 150.0;
  bool automatic = false;  ///< fitted to the picture, and labelled so
  /// 0..1 along the colour map, clamped.
  [[nodiscard]] double position(double celsius) const;
  /// From the 1st percentile to the maximum of the picture, at least 10 K wide. @pre image is
  /// valid.
  [[nodiscard]] static ThermalScale fitted(const ThermalImage& image);
};

[[nodiscard]] constexpr double toCelsius(double kelvin) { return kelvin - 273.15; }

/// True if the picture has all its pixels.
[[nodiscard]] bool isWhole(const ThermalImage& image);
/// True if the counts are temperatures.
[[nodiscard]] bool hasTemperatures(const ThermalImage& image);

/// One pixel of output for one of input: temperatures by the map, or plain grey counts where they
/// are no temperatures. A null image if the picture is not whole.
[[nodiscard]] QImage colorize(const ThermalImage& image, const ThermalScale& scale,
                              const PerceptualMap& map);

/// Hottest pixel, Celsius; nullopt without temperatures.
[[nodiscard]] std::optional<double> peakCelsius(const ThermalImage& image);
/// nullopt outside the picture or without temperatures.
[[nodiscard]] std::optional<double> celsiusAt(const ThermalImage& image, int u, int v);

}  // namespace kiln::gui
