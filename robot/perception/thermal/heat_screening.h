#pragma once

#include <deque>
#include <vector>

#include "common/wire/fire/fire_model.h"
#include "robot/perception/thermal/blob_segmenter.h"

namespace kiln::thermal {

/// How alike two segments look along the line that would mirror one into the other: normalised
/// correlation (-1..1) of their heat profiles along the perpendicular of the line between their
/// centres.
[[nodiscard]] double mirrorLikeness(const KelvinImage& image, const Segment& a,
                                    const HeatBlob& blob_a, const Segment& b,
                                    const HeatBlob& blob_b);

/// True if the two bounding boxes nearly touch: a reflection begins where its object ends.
[[nodiscard]] bool areNeighbours(const HeatBlob& a, const HeatBlob& b);

/// Follows the blobs of successive images and notices those whose peak goes up and down by more
/// than `flicker_k` from frame to frame: flames. A steady source that merely enters or leaves the
/// picture only rises or only falls.
class FlickerTracker {
 public:
  explicit FlickerTracker(double flicker_k) : flicker_k_(flicker_k) {}
  /// @return for each blob whether it flickers.
  [[nodiscard]] std::vector<bool> update(const std::vector<HeatBlob>& blobs);
  void reset() { tracks_.clear(); }

 private:
  struct Track {
    double u = 0, v = 0;
    std::deque<double> peaks_k;
  };
  [[nodiscard]] bool flickers(const Track& track) const;

  double flicker_k_;
  std::vector<Track> tracks_;
};

}  // namespace kiln::thermal
