#include "robot/perception/cloud/arm_track.h"

#include <algorithm>

namespace kiln {

void ArmTrack::push(Stamp stamp, const Vector6d& q) {
  if (!q.allFinite() || (!samples_.empty() && stamp <= samples_.back().stamp)) return;
  samples_.push_back({stamp, q});
  while (samples_.size() > 2 && samples_[1].stamp < stamp - kept_) samples_.pop_front();
}

std::optional<Vector6d> ArmTrack::at(Stamp stamp) const {
  if (samples_.empty()) return std::nullopt;
  const auto after = std::lower_bound(samples_.begin(), samples_.end(), stamp,
                                      [](const Sample& s, Stamp t) { return s.stamp < t; });
  if (after == samples_.begin()) return after->q;
  if (after == samples_.end()) return samples_.back().q;
  const auto before = std::prev(after);
  const double s = toSeconds(stamp - before->stamp) / toSeconds(after->stamp - before->stamp);
  return Vector6d(before->q + s * (after->q - before->q));
}

}  // namespace kiln
