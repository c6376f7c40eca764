#include "gui/views/color/perceptual_map.h"

#include <algorithm>
#include <cmath>

#include "common/core/units.h"

namespace kiln::gui {
namespace {

struct Lab {
  double L = 0.0, a = 0.0, b = 0.0;
};

double fromGamma(std::uint8_t v) {
  const double s = v / 255.0;
  return s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4);
}

double toGamma(double linear) {
  const double v = std::clamp(linear, 0.0, 1.0);
  return v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1.0 / 2.4) - 0.055;
}

Lab toLab(Rgb color) {
  const double r = fromGamma(color.r), g = fromGamma(color.g), b = fromGamma(color.b);
  const double l = std::cbrt(0.4122214708 * r + 0.5363325363 * g + 0.0514459929 * b);
  const double m = std::cbrt(0.2119034982 * r + 0.6806995451 * g + 0.1073969566 * b);
  const double s = std::cbrt(0.0883024619 * r + 0.2817188376 * g + 0.6299787005 * b);
  return {0.2104542553 * l + 0.7936177850 * m - 0.0040720468 * s,
          1.9779984951 * l - 2.4285922050 * m + 0.4505937099 * s,
          0.0259040371 * l + 0.7827717662 * m - 0.8086757660 * s};
}

std::array<double, 3> toLinear(const Lab& c) {
  const double l = std::pow(c.L + 0.3963377774 * c.a + 0.2158037573 * c.b, 3.0);
  const double m = std::pow(c.L - 0.1055613458 * c.a - 0.0638541728 * c.b, 3.0);
  const double s = std::pow(c.L - 0.0894841775 * c.a - 1.2914855480 * c.b, 3.0);
  return {4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s,
          -1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s,
          -0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s};
}

bool insideGamut(const std::array<double, 3>& linear) {
  return std::all_of(linear.begin(), linear.end(),
                     [](double v) { return v >= -1e-4 && v <= 1.0 + 1e-4; });
}

Rgb toRgb(const Lab& c) {
  const auto linear = toLinear(c);
  const auto byte = [](double v) {
    return static_cast<std::uint8_t>(std::lround(255.0 * toGamma(v)));
  };
  return {byte(linear[0]), byte(linear[1]), byte(linear[2])};
}

/// Gives up chroma, never lightness, where sRGB cannot show the colour.
Rgb toRgbKeepingLightness(Lab c) {
  for (int step = 0; step < 40 && !insideGamut(toLinear(c)); ++step) {
    c.a *= 0.95;
    c.b *= 0.95;
  }
  return toRgb(c);
}

Lab chromaticityAt(double t, const std::vector<PerceptualMap::Anchor>& anchors) {
  const auto plane = [](const PerceptualMap::Anchor& k) {
    const double hue = k.hue_deg * kDeg;
    return Lab{0.0, k.chroma * std::cos(hue), k.chroma * std::sin(hue)};
  };
  const auto upper = std::find_if(anchors.begin() + 1, anchors.end() - 1,
                                  [t](const PerceptualMap::Anchor& k) { return k.at >= t; });
  const Lab low = plane(*(upper - 1)), high = plane(*upper);
  const double s = (t - (upper - 1)->at) / (upper->at - (upper - 1)->at);
  return {0.0, low.a + s * (high.a - low.a), low.b + s * (high.b - low.b)};
}

}  // namespace

Rgb mix(Rgb a, Rgb b, double s) {
  const double k = std::clamp(s, 0.0, 1.0);
  const auto channel = [k](std::uint8_t p, std::uint8_t q) {
    return static_cast<std::uint8_t>(std::lround((1.0 - k) * p + k * q));
  };
  return {channel(a.r, b.r), channel(a.g, b.g), channel(a.b, b.b)};
}

Rgb desaturate(Rgb color, double amount) {
  Lab lab = toLab(color);
  const double keep = 1.0 - std::clamp(amount, 0.0, 1.0);
  lab.a *= keep;
  lab.b *= keep;
  return toRgb(lab);
}

double lightness(Rgb color) { return toLab(color).L; }

PerceptualMap::PerceptualMap(double lightness_low, double lightness_high,
                             const std::vector<Anchor>& anchors) {
  for (std::size_t i = 0; i < table_.size(); ++i) {
    const double t = static_cast<double>(i) / static_cast<double>(table_.size() - 1);
    Lab c = chromaticityAt(t, anchors);
    c.L = lightness_low + t * (lightness_high - lightness_low);
    table_[i] = toRgbKeepingLightness(c);
  }
}

PerceptualMap PerceptualMap::heat() {
  return {0.10,
          0.97,
          {{0.0, 0.04, 285},
           {0.22, 0.14, 300},
           {0.42, 0.18, 350},
           {0.60, 0.19, 28},
           {0.78, 0.17, 60},
           {1.0, 0.10, 103}}};
}

PerceptualMap PerceptualMap::height(bool dark_ground) {
  const std::vector<Anchor> anchors{
      {0.0, 0.10, 250}, {0.35, 0.09, 215}, {0.65, 0.09, 165}, {1.0, 0.11, 110}};
  return dark_ground ? PerceptualMap{0.50, 0.90, anchors} : PerceptualMap{0.30, 0.66, anchors};
}

Rgb PerceptualMap::at(double t) const {
  if (!(t > 0.0)) return table_.front();
  return table_[static_cast<std::size_t>(std::lround(std::min(t, 1.0) * 255.0))];
}

}  // namespace kiln::gui
