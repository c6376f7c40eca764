#include "robot/perception/thermal/blob_shape.h"

#include <algorithm>
#include <cmath>

namespace kiln::thermal {
namespace {

constexpr int kSamplesPerPixel = 4;
constexpr double kCentreFloor = 0.3;  // share of the plateau's excess below which a pixel is noise
constexpr std::size_t kMinRingPixels = 12;

struct Box {
  int u_min, v_min, u_max, v_max;
  void add(int u, int v) {
    u_min = std::min(u_min, u);
    v_min = std::min(v_min, v);
    u_max = std::max(u_max, u);
    v_max = std::max(v_max, v);
  }
};

template <class Accept>
Box boundingBox(const KelvinImage& image, const Segment& segment, Accept accept) {
  Box box{image.width, image.height, -1, -1};
  for (const int index : segment.pixels) {
    if (accept(image.kelvin[static_cast<std::size_t>(index)])) {
      box.add(index % image.width, index / image.width);
    }
  }
  return box;
}

double medianOf(std::vector<float>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Median of the pixels around the box that belong to no segment; `fallback` if there are too few.
double localBackground(const KelvinImage& image, const Segmentation& segmentation, const Box& box,
                       double fallback) {
  const int margin = std::max(4, (box.u_max - box.u_min + box.v_max - box.v_min) / 4);
  std::vector<float> ring;
  for (int v = std::max(0, box.v_min - margin); v <= std::min(image.height - 1, box.v_max + margin);
       ++v) {
    for (int u = std::max(0, box.u_min - margin);
         u <= std::min(image.width - 1, box.u_max + margin); ++u) {
      if (segmentation.label[static_cast<std::size_t>(v * image.width + u)] < 0)
        ring.push_back(image.at(u, v));
    }
  }
  return ring.size() < kMinRingPixels ? fallback : medianOf(ring);
}

/// Typical temperature of the object: median of what lies above half of the highest value.
double plateauOf(const KelvinImage& image, const Segment& segment, double background_k) {
  const double half = 0.5 * (segment.peak_k + background_k);
  std::vector<float> core;
  for (const int index : segment.pixels) {
    const float t = image.kelvin[static_cast<std::size_t>(index)];
    if (t >= half) core.push_back(t);
  }
  return core.empty() ? segment.peak_k : medianOf(core);
}

double bilinear(const KelvinImage& image, double u, double v) {
  const double uc = std::clamp(u, 0.0, image.width - 1.0),
               vc = std::clamp(v, 0.0, image.height - 1.0);
  const int u0 = std::min(static_cast<int>(uc), image.width - 2),
            v0 = std::min(static_cast<int>(vc), image.height - 2);
  const double fu = uc - u0, fv = vc - v0;
  return (1 - fv) * ((1 - fu) * image.at(u0, v0) + fu * image.at(u0 + 1, v0)) +
         fv * ((1 - fu) * image.at(u0, v0 + 1) + fu * image.at(u0 + 1, v0 + 1));
}

double areaAbove(const KelvinImage& image, const Segment& segment, double level_k) {
  int hits = 0;
  for (const int index : segment.pixels) {
    const int u = index % image.width, v = index / image.width;
    for (int j = 0; j < kSamplesPerPixel; ++j) {
      for (int i = 0; i < kSamplesPerPixel; ++i) {
        const double su = u + (i + 0.5) / kSamplesPerPixel - 0.5;
        const double sv = v + (j + 0.5) / kSamplesPerPixel - 0.5;
        hits += bilinear(image, su, sv) >= level_k ? 1 : 0;
      }
    }
  }
  return static_cast<double>(hits) / (kSamplesPerPixel * kSamplesPerPixel);
}

}  // namespace

HeatBlob measureBlob(const KelvinImage& image, const Segmentation& segmentation,
                     std::size_t segment, double background_k, double box_level_k) {
  const Segment& pixels = segmentation.segments[segment];
  const Box extent = boundingBox(image, pixels, [](float) { return true; });
  HeatBlob blob;
  blob.peak_k = pixels.peak_k;
  blob.background_k = localBackground(image, segmentation, extent, background_k);
  const double plateau = plateauOf(image, pixels, blob.background_k);
  const double excess = std::max(plateau - blob.background_k, 1e-3);
  const double half = blob.background_k + 0.5 * excess;
  blob.half_max_area_px = areaAbove(image, pixels, half);

  double sum = 0, sum_u = 0, sum_v = 0;
  for (const int index : pixels.pixels) {
    const double share =
        std::min(1.0, (image.kelvin[static_cast<std::size_t>(index)] - blob.background_k) / excess);
    if (share < kCentreFloor) continue;
    sum += share;
    sum_u += share * (index % image.width);
    sum_v += share * (index / image.width);
  }
  const int peak = pixels.pixels.front();
  blob.u = sum > 0 ? sum_u / sum : peak % image.width;
  blob.v = sum > 0 ? sum_v / sum : peak / image.width;

  Box box = boundingBox(image, pixels, [&](float t) { return t >= box_level_k; });
  if (box.u_max < 0) box = boundingBox(image, pixels, [&](float t) { return t >= half; });
  if (box.u_max < 0) box = extent;
  blob.u_min = box.u_min;
  blob.v_min = box.v_min;
  blob.u_max = box.u_max;
  blob.v_max = box.v_max;
  return blob;
}

}  // namespace kiln::thermal
