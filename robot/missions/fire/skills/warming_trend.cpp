#include "robot/missions/fire/skills/warming_trend.h"

#include <algorithm>
#include <cmath>

#include "common/core/units.h"

namespace kiln {
namespace {

/// Lepton 3.5.
const CameraModel& camera() {
  static const CameraModel lepton = CameraModel::fromHorizontalFov(160, 120, 57.0 * kDeg);
  return lepton;
}

}  // namespace

void WarmingConfig::visit(ConfigArchive& a) {
  a.field("gate_px", gate_px, "px", 1, 200, "a warm blob nearer to the place is that of the place");
  a.field("min_rise_kps", min_rise_kps, "K/s", 0.01, 10, "slower is drift of the camera");
  a.field("significance", significance, "", 0, 20, "the rise is so many of its own sigmas");
  a.field("min_views", min_views, "", 3, 1000, "for a straight line");
}

void WarmingTrend::begin(const Eigen::Vector3d& p_place_map) {
  p_place_map_ = p_place_map;
  first_.reset();
  views_.clear();
}

void WarmingTrend::add(const HeatDetections& detections, const Eigen::Isometry3d& X_map_thermal) {
  if (!detections.usable || !isFinite(X_map_thermal)) return;
  const auto place_px = camera().project(X_map_thermal.inverse() * p_place_map_);
  if (!place_px) return;
  const HeatBlob* nearest = nullptr;
  double nearest_px = config_.gate_px;
  for (const HeatBlob& blob : detections.blobs) {
    const double off_px = (Eigen::Vector2d(blob.u, blob.v) - *place_px).norm();
    if (blob.rejection == HeatRejection::Reflection || off_px >= nearest_px) continue;
    nearest = &blob;
    nearest_px = off_px;
  }
  if (nearest == nullptr) return;
  if (!first_) first_ = detections.stamp;
  views_.push_back({toSeconds(detections.stamp - *first_), nearest->peak_k});
}

std::optional<double> WarmingTrend::rise() const {
  const auto n = static_cast<double>(views_.size());
  if (views_.size() < static_cast<std::size_t>(config_.min_views)) return std::nullopt;
  double mean_t = 0.0, mean_k = 0.0;
  for (const View& view : views_) {
    mean_t += view.t_s / n;
    mean_k += view.peak_k / n;
  }
  double tt = 0.0, tk = 0.0, kk = 0.0;
  for (const View& view : views_) {
    const double t = view.t_s - mean_t, k = view.peak_k - mean_k;
    tt += t * t;
    tk += t * k;
    kk += k * k;
  }
  if (!(tt > 0.0)) return std::nullopt;
  const double slope = tk / tt;
  const double residual = std::max(0.0, kk - slope * tk) / (n - 2.0);
  if (slope < config_.min_rise_kps || slope < config_.significance * std::sqrt(residual / tt))
    return std::nullopt;
  return slope;
}

}  // namespace kiln
