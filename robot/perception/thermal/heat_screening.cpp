#include "robot/perception/thermal/heat_screening.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace kiln::thermal {
namespace {

constexpr double kMaxStep_px = 25.0;  // how far a blob moves between frames of a sweeping arm
constexpr std::size_t kHistory = 8;   // frames, about 0.9 s
constexpr int kMinReversals = 2;

/// Excess heat per one-pixel slice along `direction`.
std::map<int, double> profile(const KelvinImage& image, const Segment& segment,
                              const HeatBlob& blob, const Eigen::Vector2d& direction) {
  std::map<int, double> out;
  const double half = 0.5 * (segment.peak_k + blob.background_k);
  for (const int index : segment.pixels) {
    const float t = image.kelvin[static_cast<std::size_t>(index)];
    if (t < half) continue;
    const double s = direction.dot(Eigen::Vector2d(index % image.width, index / image.width));
    out[static_cast<int>(std::lround(s))] += t - blob.background_k;
  }
  return out;
}

}  // namespace

double mirrorLikeness(const KelvinImage& image, const Segment& a, const HeatBlob& blob_a,
                      const Segment& b, const HeatBlob& blob_b) {
  const Eigen::Vector2d between(blob_b.u - blob_a.u, blob_b.v - blob_a.v);
  if (between.norm() < 1.0) return 0.0;
  // A mirror seen at an angle shifts the copy along its own axis too: the axis is the image row or
  // column nearest.
  const Eigen::Vector2d along =
      std::abs(between.x()) > std::abs(between.y()) ? Eigen::Vector2d(0, 1) : Eigen::Vector2d(1, 0);
  const auto pa = profile(image, a, blob_a, along);
  const auto pb = profile(image, b, blob_b, along);
  if (pa.empty() || pb.empty()) return 0.0;
  const int first = std::min(pa.begin()->first, pb.begin()->first) - 2;
  const int last = std::max(pa.rbegin()->first, pb.rbegin()->first) + 2;
  const auto value = [](const std::map<int, double>& p, int s) {
    const auto it = p.find(s);
    return it == p.end() ? 0.0 : it->second;
  };
  const double n = last - first + 1;
  double mean_a = 0, mean_b = 0;
  for (int s = first; s <= last; ++s) {
    mean_a += value(pa, s) / n;
    mean_b += value(pb, s) / n;
  }
  double aa = 0, bb = 0, ab = 0;
  for (int s = first; s <= last; ++s) {
    const double da = value(pa, s) - mean_a, db = value(pb, s) - mean_b;
    aa += da * da;
    bb += db * db;
    ab += da * db;
  }
  return aa > 0 && bb > 0 ? ab / std::sqrt(aa * bb) : 0.0;
}

bool areNeighbours(const HeatBlob& a, const HeatBlob& b) {
  const int gap_u = std::max(a.u_min, b.u_min) - std::min(a.u_max, b.u_max);
  const int gap_v = std::max(a.v_min, b.v_min) - std::min(a.v_max, b.v_max);
  const int size = std::max(a.u_max - a.u_min, a.v_max - a.v_min) + 1;
  return std::max(gap_u, gap_v) <= std::max(3, size / 2);
}

bool FlickerTracker::flickers(const Track& track) const {
  int reversals = 0;
  int last_sign = 0;
  for (std::size_t i = 1; i < track.peaks_k.size(); ++i) {
    const double step = track.peaks_k[i] - track.peaks_k[i - 1];
    if (std::abs(step) < flicker_k_) continue;
    const int sign = step > 0 ? 1 : -1;
    if (last_sign != 0 && sign != last_sign) ++reversals;
    last_sign = sign;
  }
  return reversals >= kMinReversals;
}

std::vector<bool> FlickerTracker::update(const std::vector<HeatBlob>& blobs) {
  std::vector<Track> next;
  std::vector<bool> out;
  std::vector<bool> taken(tracks_.size(), false);
  for (const HeatBlob& blob : blobs) {
    Track track;
    double nearest = kMaxStep_px;
    std::size_t match = tracks_.size();
    for (std::size_t i = 0; i < tracks_.size(); ++i) {
      const double distance = std::hypot(tracks_[i].u - blob.u, tracks_[i].v - blob.v);
      if (taken[i] || distance >= nearest) continue;
      nearest = distance;
      match = i;
    }
    if (match < tracks_.size()) {
      taken[match] = true;
      track.peaks_k = std::move(tracks_[match].peaks_k);
    }
    track.u = blob.u;
    track.v = blob.v;
    track.peaks_k.push_back(blob.peak_k);
    if (track.peaks_k.size() > kHistory) track.peaks_k.pop_front();
    out.push_back(flickers(track));
    next.push_back(std::move(track));
  }
  tracks_ = std::move(next);
  return out;
}

}  // namespace kiln::thermal
