#include "robot/missions/fire/skills/heat_watch.h"

#include <algorithm>

namespace kiln {
namespace {
constexpr double kLongestFrameGap_s =
    0.3;  // a longer gap is a freeze or a dead stream, not unseen time

bool accepted(const HeatDetections& detections) {
  return std::any_of(detections.blobs.begin(), detections.blobs.end(),
                     [](const HeatBlob& blob) { return blob.rejection == HeatRejection::None; });
}

double age(const std::optional<Stamp>& stamp, Stamp now) {
  return stamp ? toSeconds(now - *stamp) : -1.0;
}

}  // namespace

void HeatWatch::begin(const Eigen::Vector3d& normal_map) {
  sweep_.begin();
  estimate_is_current_ = false;
  sightings_ = looks_ = 0;
  last_seen_.reset();
  last_usable_.reset();
  listen(normal_map);
}

void HeatWatch::listen(const Eigen::Vector3d& normal_map) {
  normal_map_ = normal_map;
  listening_ = true;
  unseen_for_s_ = 0.0;
}

void HeatWatch::onDetections(const HeatDetections& detections,
                             const Eigen::Isometry3d& X_map_thermal) {
  last_image_ = detections.stamp;
  last_refusal_ = detections.usable ? std::string{} : detections.refusal;
  if (!detections.usable || !listening_ || !isFinite(X_map_thermal)) return;
  ++looks_;
  if (accepted(detections)) {
    ++sightings_;
    last_seen_ = detections.stamp;
    unseen_for_s_ = 0.0;
  } else if (last_usable_) {
    unseen_for_s_ += std::min(kLongestFrameGap_s, toSeconds(detections.stamp - *last_usable_));
  }
  last_usable_ = detections.stamp;
  estimate_is_current_ = false;
  sweep_.add(detections, X_map_thermal, normal_map_);
}

const std::optional<FireEstimate>& HeatWatch::estimate() {
  if (!estimate_is_current_) estimate_ = sweep_.estimate();
  estimate_is_current_ = true;
  return estimate_;
}

double HeatWatch::imageAgeS(Stamp now) const { return age(last_image_, now); }
double HeatWatch::seenAgeS(Stamp now) const { return age(last_seen_, now); }

}  // namespace kiln
