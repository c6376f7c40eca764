#include "common/wire/cloud_codec.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string_view>

#include "common/core/check.h"
#include "common/wire/compress.h"

namespace kiln::wire {
namespace {

constexpr std::int16_t kNoReturn = std::numeric_limits<std::int16_t>::min();
constexpr double kMinResolution_m = 0.0005;
constexpr double kMaxResolution_m = 0.1;

std::uint16_t zigzag(std::uint16_t delta) {
  return static_cast<std::uint16_t>((delta << 1) ^ ((delta & 0x8000u) != 0 ? 0xFFFFu : 0u));
}
std::uint16_t unzigzag(std::uint16_t code) {
  return static_cast<std::uint16_t>((code >> 1) ^ ((code & 1u) != 0 ? 0xFFFFu : 0u));
}
std::uint8_t byteAt(std::string_view plane, std::size_t i) {
  return static_cast<std::uint8_t>(plane[i]);
}

/// Writes 16-bit codes into a high and a low byte plane, which zstd packs better than interleaved.
class PlaneWriter {
 public:
  PlaneWriter(std::string& out, std::size_t first, std::size_t n)
      : high_(&out[first]), low_(&out[first] + n) {}
  void put(std::size_t i, std::uint16_t code) {
    high_[i] = static_cast<char>(code >> 8);
    low_[i] = static_cast<char>(code & 0xFFu);
  }

 private:
  char* high_;
  char* low_;
};
std::uint16_t codeAt(std::string_view planes, std::size_t first, std::size_t n, std::size_t i) {
  return static_cast<std::uint16_t>((byteAt(planes, first + i) << 8) |
                                    byteAt(planes, first + n + i));
}

std::int16_t quantise(float value, double inverse_resolution) {
  const double steps = std::round(static_cast<double>(value) * inverse_resolution);
  if (!(std::abs(steps) <= 32767.0)) return kNoReturn;  // NaN comes here too
  return static_cast<std::int16_t>(steps);
}

using Last = std::array<std::array<std::uint16_t, 3>, 256>;  // per ring; rings are one byte

std::string packCoordinates(const PointCloud& cloud, std::size_t n, double resolution_m) {
  std::string planes(6 * n, '\0');
  if (n == 0) return planes;
  std::array<PlaneWriter, 3> out{PlaneWriter(planes, 0, n), PlaneWriter(planes, 2 * n, n),
                                 PlaneWriter(planes, 4 * n, n)};
  Last last{};
  const double inverse = 1.0 / resolution_m;
  for (std::size_t i = 0; i < n; ++i) {
    std::array<std::int16_t, 3> q{quantise(cloud.x[i], inverse), quantise(cloud.y[i], inverse),
                                  quantise(cloud.z[i], inverse)};
    const bool none = std::find(q.begin(), q.end(), kNoReturn) != q.end();
    if (none) q.fill(kNoReturn);
    auto& previous = last[cloud.ring[i]];
    for (std::size_t k = 0; k < 3; ++k) {
      const auto value = static_cast<std::uint16_t>(q[k]);
      out[k].put(i, zigzag(static_cast<std::uint16_t>(value - previous[k])));
      if (!none) previous[k] = value;  // a gap does not spoil the prediction behind it
    }
  }
  return planes;
}

std::string packTimes(const PointCloud& cloud, std::size_t n) {
  std::string planes(2 * n, '\0');
  if (n == 0) return planes;
  PlaneWriter out(planes, 0, n);
  std::uint16_t previous = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const double units = static_cast<double>(cloud.time_offset_s[i]) / kCloudTimeUnit_s;
    const auto value = static_cast<std::uint16_t>(
        std::isfinite(units) ? std::clamp(units + 0.5, 0.0, 65535.0) : 0.0);
    out.put(i, zigzag(static_cast<std::uint16_t>(value - previous)));
    previous = value;
  }
  return planes;
}

void unpackCoordinates(std::string_view planes, std::size_t n, double resolution_m,
                       PointCloud& cloud) {
  Last last{};
  const std::array<std::vector<float>*, 3> out{&cloud.x, &cloud.y, &cloud.z};
  for (auto* axis : out) axis->resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    auto& previous = last[cloud.ring[i]];
    std::array<std::uint16_t, 3> value{};
    bool none = false;
    for (std::size_t k = 0; k < 3; ++k) {
      value[k] =
          static_cast<std::uint16_t>(previous[k] + unzigzag(codeAt(planes, 2 * k * n, n, i)));
      none = none || static_cast<std::int16_t>(value[k]) == kNoReturn;
    }
    if (!none) previous = value;
    for (std::size_t k = 0; k < 3; ++k) {
      (*out[k])[i] = none ? std::numeric_limits<float>::quiet_NaN()
                          : static_cast<float>(static_cast<std::int16_t>(value[k]) * resolution_m);
    }
  }
}

}  // namespace

v1::Cloud packCloud(const PointCloud& cloud, double resolution_m) {
  KILN_CHECK(resolution_m >= kMinResolution_m && resolution_m <= kMaxResolution_m, resolution_m);
  KILN_CHECK(cloud.y.size() == cloud.size() && cloud.z.size() == cloud.size() &&
                 cloud.intensity.size() == cloud.size() && cloud.ring.size() == cloud.size() &&
                 cloud.time_offset_s.size() == cloud.size(),
             "cloud arrays differ in length", cloud.size());
  const std::size_t n = std::min<std::size_t>(cloud.size(), kMaxCloudPoints);
  const auto bytes = [n](const std::vector<std::uint8_t>& v) {
    return std::string_view(reinterpret_cast<const char*>(v.data()), n);
  };
  v1::Cloud packed;
  packed.set_points(static_cast<std::uint32_t>(n));
  packed.set_resolution_m(resolution_m);
  packed.set_xyz(compress(packCoordinates(cloud, n, resolution_m)));
  packed.set_intensity(compress(bytes(cloud.intensity)));
  packed.set_ring(compress(bytes(cloud.ring)));
  packed.set_time(compress(packTimes(cloud, n)));
  return packed;
}

Result<PointCloud> unpackCloud(const v1::Cloud& packed) {
  const double resolution_m = packed.resolution_m();
  if (packed.points() > kMaxCloudPoints) {
    return makeError(ErrorCode::InvalidInput, "cloud: {} points are more than {}; dropped",
                     packed.points(), kMaxCloudPoints);
  }
  if (!(resolution_m >= kMinResolution_m && resolution_m <= kMaxResolution_m)) {
    return makeError(ErrorCode::InvalidInput,
                     "cloud: resolution {} m is not within {} to {}; dropped", resolution_m,
                     kMinResolution_m, kMaxResolution_m);
  }
  const std::size_t n = packed.points();
  const auto ring = decompress(packed.ring(), n, "cloud ring");
  if (!ring) return tl::make_unexpected(ring.error());
  const auto intensity = decompress(packed.intensity(), n, "cloud intensity");
  if (!intensity) return tl::make_unexpected(intensity.error());
  const auto xyz = decompress(packed.xyz(), 6 * n, "cloud xyz");
  if (!xyz) return tl::make_unexpected(xyz.error());
  const auto time = decompress(packed.time(), 2 * n, "cloud time");
  if (!time) return tl::make_unexpected(time.error());

  PointCloud cloud;
  cloud.ring.assign(ring->begin(), ring->end());
  cloud.intensity.assign(intensity->begin(), intensity->end());
  unpackCoordinates(*xyz, n, resolution_m, cloud);
  cloud.time_offset_s.resize(n);
  std::uint16_t units = 0;
  for (std::size_t i = 0; i < n; ++i) {
    units = static_cast<std::uint16_t>(units + unzigzag(codeAt(*time, 0, n, i)));
    cloud.time_offset_s[i] = static_cast<float>(units * kCloudTimeUnit_s);
  }
  return cloud;
}

}  // namespace kiln::wire
