#include "robot/perception/thermal/heat_detector.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "robot/perception/thermal/blob_segmenter.h"
#include "robot/perception/thermal/blob_shape.h"
#include "robot/perception/thermal/heat_screening.h"

namespace kiln {
namespace {
constexpr double kZeroCelsius_k = 273.15;
double celsius(double kelvin) { return kelvin - kZeroCelsius_k; }
}  // namespace

void HeatDetector::Config::visit(ConfigArchive& a) {
  a.field("threshold_c", threshold_c, "deg C", -40, 450, "accepted peaks are hotter");
  a.field("report_c", report_c, "deg C", -40, 450, "cooler blobs are not even listed");
  a.field("min_area_px", min_area_px, "px", 1, 10000, "smaller half-maximum areas are no source");
  a.field("reflection_ratio", reflection_ratio, "", 0, 1,
          "a reflection has at most this share of its object's excess temperature");
  a.field("reflection_likeness", reflection_likeness, "", 0, 1,
          "correlation of the mirrored profiles from which a copy is a reflection");
  a.field("flame_flicker_k", flame_flicker_k, "K", 0.5, 500,
          "frame-to-frame change that marks a flame");
  a.field("modelled_latency_s", modelled_latency_s, "s", 0, 1,
          "lockstep: result arrives this late");
}

struct HeatDetector::Impl {
  explicit Impl(Config c) : config(c), flicker(c.flame_flicker_k) {}

  [[nodiscard]] std::string refuse(const ThermalImage& image);
  void judge(const thermal::KelvinImage& kelvin, const thermal::Segmentation& segmentation,
             std::vector<HeatBlob>& blobs);
  [[nodiscard]] std::optional<std::size_t> objectOf(const thermal::KelvinImage& kelvin,
                                                    const thermal::Segmentation& segmentation,
                                                    const std::vector<HeatBlob>& blobs,
                                                    std::size_t copy) const;

  Config config;
  thermal::FlickerTracker flicker;
  std::optional<std::uint32_t> last_frame_counter;
  int frozen_frames = 0;
};

HeatDetector::HeatDetector(Config config) : impl_(std::make_unique<Impl>(config)) {}
HeatDetector::~HeatDetector() = default;
HeatDetector::HeatDetector(HeatDetector&&) noexcept = default;
HeatDetector& HeatDetector::operator=(HeatDetector&&) noexcept = default;

void HeatDetector::reset() { *impl_ = Impl(impl_->config); }

/// @return why the frame cannot be read as temperatures now; empty if it can.
std::string HeatDetector::Impl::refuse(const ThermalImage& image) {
  const bool same = last_frame_counter == image.frame_counter;
  last_frame_counter = image.frame_counter;
  frozen_frames = same ? frozen_frames + 1 : 0;
  if (image.width < 8 || image.height < 8 ||
      image.counts.size() !=
          static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height)) {
    return fmt::format("thermal frame has {} values for {} x {} pixels; check the camera's format",
                       image.counts.size(), image.width, image.height);
  }
  if (image.agc) return "AGC is on: the picture shows contrast, not temperatures";
  if (!image.tlinear || !(image.kelvin_per_count > 0)) {
    return "no TLinear telemetry: counts cannot be read as kelvin";
  }
  if (image.ffc == FfcState::Running)
    return "frozen: the camera's shutter is closed for its flat-field correction";
  if (same) {
    return fmt::format("frozen: the camera's frame counter stands at {} for {} frame{}",
                       image.frame_counter, frozen_frames, frozen_frames == 1 ? "" : "s");
  }
  return {};
}

std::optional<std::size_t> HeatDetector::Impl::objectOf(const thermal::KelvinImage& kelvin,
                                                        const thermal::Segmentation& segmentation,
                                                        const std::vector<HeatBlob>& blobs,
                                                        std::size_t copy) const {
  for (std::size_t i = 0; i < copy; ++i) {  // warmer ones come first
    const double excess = blobs[i].peak_k - blobs[i].background_k;
    if (celsius(blobs[i].peak_k) < config.threshold_c || blobs[i].rejection != HeatRejection::None)
      continue;
    if (blobs[copy].peak_k - blobs[copy].background_k > config.reflection_ratio * excess) continue;
    if (!thermal::areNeighbours(blobs[i], blobs[copy])) continue;
    if (thermal::mirrorLikeness(kelvin, segmentation.segments[i], blobs[i],
                                segmentation.segments[copy],
                                blobs[copy]) >= config.reflection_likeness) {
      return i;
    }
  }
  return std::nullopt;
}

void HeatDetector::Impl::judge(const thermal::KelvinImage& kelvin,
                               const thermal::Segmentation& segmentation,
                               std::vector<HeatBlob>& blobs) {
  const std::vector<bool> flickers = flicker.update(blobs);
  for (std::size_t i = 0; i < blobs.size(); ++i) {
    HeatBlob& blob = blobs[i];
    const double peak_c = celsius(blob.peak_k);
    if (flickers[i]) {
      blob.rejection = HeatRejection::Flame;
      blob.reason = fmt::format("flame: its temperature jumps by more than {:.0f} K between frames",
                                config.flame_flicker_k);
    } else if (blob.half_max_area_px < config.min_area_px) {
      blob.rejection = HeatRejection::TooSmall;
      blob.reason = fmt::format("too small: {:.1f} px, needs {} px", blob.half_max_area_px,
                                config.min_area_px);
    } else if (const auto object = objectOf(kelvin, segmentation, blobs, i)) {
      blob.rejection = HeatRejection::Reflection;
      blob.reason = fmt::format(
          "reflection: a cooler mirrored copy ({:.1f} deg C) of the source at {:.1f} deg C", peak_c,
          celsius(blobs[*object].peak_k));
    } else if (peak_c < config.threshold_c) {
      blob.rejection = HeatRejection::TooCool;
      blob.reason =
          fmt::format("too cool: {:.1f} deg C, threshold {:.1f} deg C", peak_c, config.threshold_c);
    }
  }
}

HeatDetections HeatDetector::detect(const ThermalImage& image) {
  HeatDetections out;
  out.stamp = image.stamp;
  out.image_seq = image.seq;
  out.threshold_k = impl_->config.threshold_c + kZeroCelsius_k;
  out.refusal = impl_->refuse(image);
  out.usable = out.refusal.empty();
  if (!out.usable) return out;

  const thermal::KelvinImage kelvin = thermal::toKelvin(image);
  out.max_k = *std::max_element(kelvin.kelvin.begin(), kelvin.kelvin.end());
  const double report_k = impl_->config.report_c + kZeroCelsius_k;
  if (out.max_k < report_k) {
    (void)impl_->flicker.update({});
    return out;
  }
  thermal::SegmenterLimits limits;
  limits.background_k = thermal::medianKelvin(kelvin);
  limits.min_peak_k = report_k;
  limits.floor_k = 0.5 * (report_k + std::min(limits.background_k, report_k));
  const thermal::Segmentation segmentation =
      thermal::segmentHills(thermal::smooth3x3(kelvin), limits);
  for (std::size_t i = 0; i < segmentation.segments.size(); ++i) {
    out.blobs.push_back(
        thermal::measureBlob(kelvin, segmentation, i, limits.background_k, out.threshold_k));
  }
  impl_->judge(kelvin, segmentation, out.blobs);
  std::stable_partition(out.blobs.begin(), out.blobs.end(),
                        [](const HeatBlob& b) { return b.rejection == HeatRejection::None; });
  return out;
}

}  // namespace kiln
