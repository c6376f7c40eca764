#pragma once

#include "common/config/config_archive.h"
#include "common/core/error.h"
#include "common/model/sensor.h"

namespace kiln {

/// Where cold water met a warm surface between two thermal images from one place: what became
/// cooler. What was wet before drops out, and so does the camera's fixed pattern.
struct WetSpot {
  Eigen::Vector2d centre_px = Eigen::Vector2d::Zero();  ///< weighted by the cooling
  double area_px = 0.0;
  double coolest_k = 0.0;  ///< the most that it became cooler
};

struct WetSpotConfig {
  double least_k = 1.5;   ///< cooling that counts as water
  double share = 0.12;    ///< of the strongest cooling: the spot's outline
  double least_px = 8.0;  ///< area
  void visit(ConfigArchive& a);
};

/// @param before, after  linearised frames of one camera that stood still; the jet stood between
/// them.
/// @return Error{NotFound} when nothing became cooler, or a spot that the picture's border cuts;
/// Error{InvalidInput} for frames that are frozen, not linearised or not of one size.
[[nodiscard]] Result<WetSpot> findWetSpot(const ThermalImage& before, const ThermalImage& after,
                                          const WetSpotConfig& config);

}  // namespace kiln
