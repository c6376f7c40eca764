#pragma once

#include "common/wire/fire/fire_model.h"
#include "robot/perception/thermal/blob_segmenter.h"

namespace kiln::thermal {

/// Measures one segment in the unsmoothed image: plateau and local background, half-maximum area
/// with sub-pixel edges (bilinear, 4 x 4 samples a pixel), intensity-weighted centre, and the
/// bounding box of what lies above `box_level_k` (or above half maximum where nothing reaches that
/// level).
[[nodiscard]] HeatBlob measureBlob(const KelvinImage& image, const Segmentation& segmentation,
                                   std::size_t segment, double background_k, double box_level_k);

}  // namespace kiln::thermal
