#include "robot/perception/cloud/pose_track.h"

#include <algorithm>

#include "common/core/check.h"

namespace kiln {

void PoseTrack::push(Stamp stamp, const Eigen::Isometry3d& X) {
  KILN_CHECK(samples_.empty() || samples_.back().stamp <= stamp, toSeconds(stamp));
  samples_.push_back({stamp, X});
}

Eigen::Isometry3d PoseTrack::at(Stamp stamp) const {
  KILN_CHECK(!samples_.empty());
  const auto after = std::lower_bound(samples_.begin(), samples_.end(), stamp,
                                      [](const Sample& s, Stamp t) { return s.stamp < t; });
  if (after == samples_.begin()) return after->X;
  if (after == samples_.end()) return samples_.back().X;
  const auto before = std::prev(after);
  const double s = toSeconds(stamp - before->stamp) / toSeconds(after->stamp - before->stamp);
  return interpolate(before->X, after->X, s);
}

}  // namespace kiln
