#include "gui/panels/fire/thermal_scale.h"

#include <algorithm>

namespace kiln::gui {
namespace {
constexpr double kNarrowest_k =
    10.0;  // an automatic scale narrower than this would show noise as heat
constexpr double kLowPercentile = 0.01;
}  // namespace

double ThermalScale::position(double celsius) const {
  return std::clamp((celsius - low_c) / (high_c - low_c), 0.0, 1.0);
}

bool isWhole(const ThermalImage& image) {
  return image.width > 0 && image.height > 0 &&
         image.counts.size() ==
             static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
}

bool hasTemperatures(const ThermalImage& image) {
  return isWhole(image) && image.tlinear && !image.agc;
}

ThermalScale ThermalScale::fitted(const ThermalImage& image) {
  std::vector<std::uint16_t> sorted = image.counts;
  const auto low = sorted.begin() +
                   static_cast<std::ptrdiff_t>(kLowPercentile * static_cast<double>(sorted.size()));
  std::nth_element(sorted.begin(), low, sorted.end());
  const double low_c = toCelsius(*low * image.kelvin_per_count);
  const double high_c =
      toCelsius(*std::max_element(sorted.begin(), sorted.end()) * image.kelvin_per_count);
  return {low_c, std::max(high_c, low_c + kNarrowest_k), true};
}

QImage colorize(const ThermalImage& image, const ThermalScale& scale, const PerceptualMap& map) {
  if (!isWhole(image)) return {};
  const bool warm = hasTemperatures(image);
  const auto [low, high] = std::minmax_element(image.counts.begin(), image.counts.end());
  const double span = std::max(1, *high - *low);
  QImage out(image.width, image.height, QImage::Format_RGB32);
  std::size_t i = 0;
  for (int v = 0; v < image.height; ++v) {
    auto* row = reinterpret_cast<QRgb*>(out.scanLine(v));
    for (int u = 0; u < image.width; ++u, ++i) {
      if (warm) {
        const Rgb c = map.at(scale.position(toCelsius(image.counts[i] * image.kelvin_per_count)));
        row[u] = qRgb(c.r, c.g, c.b);
      } else {
        const int grey = static_cast<int>(255.0 * (image.counts[i] - *low) / span);
        row[u] = qRgb(grey, grey, grey);
      }
    }
  }
  return out;
}

std::optional<double> peakCelsius(const ThermalImage& image) {
  if (!hasTemperatures(image)) return std::nullopt;
  return toCelsius(*std::max_element(image.counts.begin(), image.counts.end()) *
                   image.kelvin_per_count);
}

std::optional<double> celsiusAt(const ThermalImage& image, int u, int v) {
  if (!hasTemperatures(image) || u < 0 || v < 0 || u >= image.width || v >= image.height)
    return std::nullopt;
  return toCelsius(image.kelvin(u, v));
}

}  // namespace kiln::gui
