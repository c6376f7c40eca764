#include "robot/perception/calibration/wet_spot.h"

#include <vector>

namespace kiln {
namespace {

Result<void> usable(const ThermalImage& image) {
  const bool whole = image.width > 2 && image.height > 2 &&
                     image.counts.size() == static_cast<std::size_t>(image.width) *
                                                static_cast<std::size_t>(image.height);
  if (!whole || !image.tlinear || image.agc || image.ffc == FfcState::Running)
    return makeError(ErrorCode::InvalidInput,
                     "a thermal image is cut off, not linearised or taken behind the shutter");
  return {};
}

/// Cooling by pixel, K, each the mean of its neighbourhood: noise must not make the strongest one.
struct Cooling {
  int width, height;
  std::vector<double> k;

  Cooling(const ThermalImage& before, const ThermalImage& after)
      : width(before.width), height(before.height), k(before.counts.size(), 0.0) {
    for (int v = 1; v + 1 < height; ++v) {
      for (int u = 1; u + 1 < width; ++u) {
        double sum = 0.0;
        for (int dv = -1; dv <= 1; ++dv)
          for (int du = -1; du <= 1; ++du)
            sum += before.kelvin(u + du, v + dv) - after.kelvin(u + du, v + dv);
        k[index(u, v)] = sum / 9.0;
      }
    }
  }
  [[nodiscard]] std::size_t index(int u, int v) const {
    return static_cast<std::size_t>(v) * static_cast<std::size_t>(width) +
           static_cast<std::size_t>(u);
  }
};

/// Everything cooler than `level` around the strongest cooling.
struct Region {
  double weight = 0.0, area_px = 0.0;
  Eigen::Vector2d moment = Eigen::Vector2d::Zero();
  bool cut = false;  ///< by the border
};

Region grow(const Cooling& cooling, std::size_t seed, double level) {
  Region out;
  std::vector<bool> taken(cooling.k.size(), false);
  std::vector<std::size_t> open{seed};
  taken[seed] = true;
  while (!open.empty()) {
    const std::size_t at = open.back();
    open.pop_back();
    const int u = static_cast<int>(at) % cooling.width, v = static_cast<int>(at) / cooling.width;
    const double w = cooling.k[at] - level;
    out.weight += w;
    out.moment += w * Eigen::Vector2d(u, v);
    out.area_px += 1.0;
    if (u < 2 || v < 2 || u > cooling.width - 3 || v > cooling.height - 3) {
      out.cut = true;
      continue;
    }
    for (const std::size_t next :
         {at - 1, at + 1, cooling.index(u, v - 1), cooling.index(u, v + 1)}) {
      if (taken[next] || cooling.k[next] <= level) continue;
      taken[next] = true;
      open.push_back(next);
    }
  }
  return out;
}

}  // namespace

void WetSpotConfig::visit(ConfigArchive& a) {
  a.field("least_k", least_k, "K", 0.1, 50, "cooling that counts as water");
  a.field("share", share, "", 0.05, 0.95, "of the strongest cooling: the spot's outline");
  a.field("least_px", least_px, "px", 1, 1000, "area");
}

Result<WetSpot> findWetSpot(const ThermalImage& before, const ThermalImage& after,
                            const WetSpotConfig& config) {
  for (const ThermalImage* image : {&before, &after})
    if (auto ok = usable(*image); !ok) return tl::make_unexpected(ok.error());
  if (before.width != after.width || before.height != after.height ||
      before.frame_counter == after.frame_counter)
    return makeError(
        ErrorCode::InvalidInput,
        "the two thermal images are one frame, or of two sizes: is the camera frozen?");
  const Cooling cooling(before, after);
  std::size_t strongest = 0;
  for (std::size_t i = 0; i < cooling.k.size(); ++i)
    if (cooling.k[i] > cooling.k[strongest]) strongest = i;
  const double most = cooling.k[strongest];
  if (!(most >= config.least_k))
    return makeError(ErrorCode::NotFound,
                     "nothing became cooler by {:.1f} K: no water, or the board is not warm",
                     config.least_k);
  const Region spot = grow(cooling, strongest, config.share * most);
  if (spot.cut)
    return makeError(ErrorCode::NotFound, "the wet spot lies at the border of the thermal image");
  if (spot.area_px < config.least_px)
    return makeError(ErrorCode::NotFound, "only {:.0f} px became cooler", spot.area_px);
  return WetSpot{spot.moment / spot.weight, spot.area_px, most};
}

}  // namespace kiln
