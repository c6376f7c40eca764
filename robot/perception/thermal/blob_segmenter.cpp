#include "robot/perception/thermal/blob_segmenter.h"

#include <algorithm>
#include <array>
#include <numeric>

namespace kiln::thermal {

KelvinImage toKelvin(const ThermalImage& image) {
  KelvinImage out{image.width, image.height, {}};
  out.kelvin.resize(image.counts.size());
  std::transform(
      image.counts.begin(), image.counts.end(), out.kelvin.begin(),
      [k = image.kelvin_per_count](std::uint16_t c) { return static_cast<float>(c * k); });
  return out;
}

KelvinImage smooth3x3(const KelvinImage& image) {
  // Separable: sums of three along rows, then along columns; edge pixels are repeated.
  const int w = image.width, h = image.height;
  KelvinImage rows = image, out = image;
  for (int v = 0; v < h; ++v) {
    for (int u = 0; u < w; ++u) {
      rows.kelvin[static_cast<std::size_t>(v * w + u)] =
          image.at(std::max(u - 1, 0), v) + image.at(u, v) + image.at(std::min(u + 1, w - 1), v);
    }
  }
  for (int v = 0; v < h; ++v) {
    for (int u = 0; u < w; ++u) {
      out.kelvin[static_cast<std::size_t>(v * w + u)] =
          (rows.at(u, std::max(v - 1, 0)) + rows.at(u, v) + rows.at(u, std::min(v + 1, h - 1))) / 9;
    }
  }
  return out;
}

double medianKelvin(const KelvinImage& image) {
  std::vector<float> values = image.kelvin;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

namespace {

/// Hills as a union-find forest while the water falls.
class Watershed {
 public:
  Watershed(const KelvinImage& image, const SegmenterLimits& limits)
      : image_(image), limits_(limits), label_(image.kelvin.size(), -1) {}

  void flood(const std::vector<int>& warmest_first) {
    for (const int index : warmest_first) place(index);
  }
  [[nodiscard]] Segmentation result(const std::vector<int>& warmest_first) const;

 private:
  struct Hill {
    int parent;
    float peak;
  };
  [[nodiscard]] int root(int hill) const {
    while (hills_[static_cast<std::size_t>(hill)].parent != hill) {
      hill = hills_[static_cast<std::size_t>(hill)].parent;
    }
    return hill;
  }
  [[nodiscard]] float peak(int hill) const { return hills_[static_cast<std::size_t>(hill)].peak; }
  [[nodiscard]] bool staysApart(int warmer, int cooler, float saddle) const {
    const double half = 0.5 * (peak(warmer) + limits_.background_k);
    return saddle < half && peak(cooler) - saddle >= limits_.min_prominence_k;
  }
  void place(int index);

  const KelvinImage& image_;
  const SegmenterLimits& limits_;
  std::vector<int> label_;
  std::vector<Hill> hills_;
};

void Watershed::place(int index) {
  const int u = index % image_.width, v = index / image_.width;
  const float level = image_.kelvin[static_cast<std::size_t>(index)];
  std::array<int, 8> touching{};
  int count = 0;
  int warmest = -1;         // hill with the highest peak among the neighbours
  int steepest_pixel = -1;  // warmest labelled neighbour: the pixel lies on its slope
  for (int dv = -1; dv <= 1; ++dv) {
    for (int du = -1; du <= 1; ++du) {
      if ((du == 0 && dv == 0) || !image_.inside(u + du, v + dv)) continue;
      const int neighbour = (v + dv) * image_.width + u + du;
      if (label_[static_cast<std::size_t>(neighbour)] < 0) continue;
      const int hill = root(label_[static_cast<std::size_t>(neighbour)]);
      touching[static_cast<std::size_t>(count++)] = hill;
      if (warmest < 0 || peak(hill) > peak(warmest)) warmest = hill;
      if (steepest_pixel < 0 || image_.kelvin[static_cast<std::size_t>(neighbour)] >
                                    image_.kelvin[static_cast<std::size_t>(steepest_pixel)]) {
        steepest_pixel = neighbour;
      }
    }
  }
  if (count == 0) {
    label_[static_cast<std::size_t>(index)] = static_cast<int>(hills_.size());
    hills_.push_back({static_cast<int>(hills_.size()), level});
    return;
  }
  for (int i = 0; i < count; ++i) {
    const int hill = root(touching[static_cast<std::size_t>(i)]);
    if (hill != warmest && !staysApart(warmest, hill, level)) {
      hills_[static_cast<std::size_t>(hill)].parent = warmest;
    }
  }
  label_[static_cast<std::size_t>(index)] = root(label_[static_cast<std::size_t>(steepest_pixel)]);
}

Segmentation Watershed::result(const std::vector<int>& warmest_first) const {
  Segmentation out;
  out.label.assign(label_.size(), -1);
  std::vector<int> segment_of(hills_.size(), -1);
  for (const int index : warmest_first) {  // a hill's first pixel is its peak: order is by peak
    const int hill = root(label_[static_cast<std::size_t>(index)]);
    if (peak(hill) < limits_.min_peak_k) continue;
    int& segment = segment_of[static_cast<std::size_t>(hill)];
    if (segment < 0) {
      segment = static_cast<int>(out.segments.size());
      out.segments.push_back({peak(hill), {}});
    }
    out.segments[static_cast<std::size_t>(segment)].pixels.push_back(index);
    out.label[static_cast<std::size_t>(index)] = segment;
  }
  return out;
}

}  // namespace

Segmentation segmentHills(const KelvinImage& image, const SegmenterLimits& limits) {
  std::vector<int> order;
  for (std::size_t i = 0; i < image.kelvin.size(); ++i) {
    if (image.kelvin[i] >= limits.floor_k) order.push_back(static_cast<int>(i));
  }
  // Stable, so that equal temperatures keep the raster order: the result never depends on the sort.
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) {
    return image.kelvin[static_cast<std::size_t>(a)] > image.kelvin[static_cast<std::size_t>(b)];
  });
  Watershed watershed(image, limits);
  watershed.flood(order);
  return watershed.result(order);
}

}  // namespace kiln::thermal
