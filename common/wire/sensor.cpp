#include "common/wire/sensor.h"

#include <cmath>
#include <cstring>

#include "common/wire/cloud_codec.h"
#include "common/wire/compress.h"
#include "common/wire/jpeg_size.h"
#include "common/wire/proto_message.h"
#include "kiln/v1/sensor.pb.h"

namespace kiln::wire {
namespace {

constexpr std::size_t kMaxStreamBytes = 16u << 20;
constexpr std::size_t kMaxFrameName = 64;
constexpr std::uint32_t kMaxThermalSide = 1024;
constexpr std::uint32_t kMaxColourSide = 8192;
constexpr std::uint64_t kMaxPixels = 4096 * 2304;  // what decodes into some 70 MiB

Result<void> checkImageSize(std::uint32_t width, std::uint32_t height, std::uint32_t limit,
                            const char* what) {
  if (width == 0 || height == 0 || width > limit || height > limit) {
    return makeError(ErrorCode::InvalidInput, "{}: {} x {} pixels are not within 1 to {}; dropped",
                     what, width, height, limit);
  }
  if (std::uint64_t{width} * height > kMaxPixels) {
    return makeError(ErrorCode::InvalidInput, "{}: {} x {} are more than {} pixels; dropped", what,
                     width, height, kMaxPixels);
  }
  return {};
}

}  // namespace

std::string encode(const PointCloud& cloud, double resolution_m) {
  v1::Cloud out = packCloud(cloud, resolution_m);
  out.set_stamp_ns(toNanoseconds(cloud.stamp));
  out.set_seq(cloud.seq);
  out.set_frame(cloud.frame);
  return serialise(out);
}

Result<PointCloud> decodeCloud(std::string_view bytes) {
  const auto in = parse<v1::Cloud>(bytes, kMaxStreamBytes, "cloud");
  if (!in) return tl::make_unexpected(in.error());
  if (in->frame().size() > kMaxFrameName) {
    return makeError(ErrorCode::InvalidInput, "cloud: frame name of {} characters; dropped",
                     in->frame().size());
  }
  auto cloud = unpackCloud(*in);
  if (!cloud) return cloud;
  cloud->stamp = stampFromNanoseconds(in->stamp_ns());
  cloud->seq = in->seq();
  cloud->frame = in->frame();
  return cloud;
}

std::string encode(const ThermalImage& image) {
  std::string raw(2 * image.counts.size(), '\0');
  for (std::size_t i = 0; i < image.counts.size(); ++i) {
    raw[2 * i] = static_cast<char>(image.counts[i] & 0xFFu);
    raw[2 * i + 1] = static_cast<char>(image.counts[i] >> 8);
  }
  v1::ThermalFrame out;
  out.set_stamp_ns(toNanoseconds(image.stamp));
  out.set_seq(image.seq);
  out.set_frame_counter(image.frame_counter);
  out.set_width(static_cast<std::uint32_t>(image.width));
  out.set_height(static_cast<std::uint32_t>(image.height));
  out.set_counts(compress(raw));
  out.set_tlinear(image.tlinear);
  out.set_kelvin_per_count(image.kelvin_per_count);
  out.set_agc(image.agc);
  out.set_ffc(static_cast<std::uint32_t>(image.ffc));
  return serialise(out);
}

Result<ThermalImage> decodeThermal(std::string_view bytes) {
  const auto in = parse<v1::ThermalFrame>(bytes, kMaxStreamBytes, "thermal image");
  if (!in) return tl::make_unexpected(in.error());
  if (auto ok = checkImageSize(in->width(), in->height(), kMaxThermalSide, "thermal image"); !ok) {
    return tl::make_unexpected(ok.error());
  }
  if (!(in->kelvin_per_count() > 0.0 && in->kelvin_per_count() <= 1.0)) {
    return makeError(ErrorCode::InvalidInput,
                     "thermal image: {} K a count is out of range; dropped",
                     in->kelvin_per_count());
  }
  const auto ffc = toEnum(in->ffc(), FfcState::Complete, "thermal shutter state");
  if (!ffc) return tl::make_unexpected(ffc.error());
  const std::size_t n = std::size_t{in->width()} * in->height();
  const auto raw = decompress(in->counts(), 2 * n, "thermal image");
  if (!raw) return tl::make_unexpected(raw.error());

  ThermalImage image;
  image.stamp = stampFromNanoseconds(in->stamp_ns());
  image.seq = in->seq();
  image.frame_counter = in->frame_counter();
  image.width = static_cast<int>(in->width());
  image.height = static_cast<int>(in->height());
  image.tlinear = in->tlinear();
  image.kelvin_per_count = in->kelvin_per_count();
  image.agc = in->agc();
  image.ffc = *ffc;
  image.counts.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    image.counts[i] =
        static_cast<std::uint16_t>(static_cast<std::uint8_t>((*raw)[2 * i]) |
                                   (static_cast<std::uint8_t>((*raw)[2 * i + 1]) << 8));
  }
  return image;
}

std::string encode(const JpegImage& image) {
  v1::ColourFrame out;
  out.set_stamp_ns(toNanoseconds(image.stamp));
  out.set_seq(image.seq);
  out.set_frame(image.frame);
  out.set_width(static_cast<std::uint32_t>(image.width));
  out.set_height(static_cast<std::uint32_t>(image.height));
  out.set_jpeg(image.jpeg.data(), image.jpeg.size());
  return serialise(out);
}

Result<JpegImage> decodeJpeg(std::string_view bytes) {
  const auto in = parse<v1::ColourFrame>(bytes, kMaxStreamBytes, "colour image");
  if (!in) return tl::make_unexpected(in.error());
  if (auto ok = checkImageSize(in->width(), in->height(), kMaxColourSide, "colour image"); !ok) {
    return tl::make_unexpected(ok.error());
  }
  if (in->jpeg().empty() || in->frame().size() > kMaxFrameName) {
    return makeError(ErrorCode::InvalidInput,
                     "colour image: {} bytes of JPEG, frame name of {} characters; dropped",
                     in->jpeg().size(), in->frame().size());
  }
  // What the picture itself says: a decoder takes memory by that.
  const auto size = jpegSize(in->jpeg());
  if (!size || size->width != static_cast<int>(in->width()) ||
      size->height != static_cast<int>(in->height())) {
    return makeError(ErrorCode::InvalidInput,
                     "colour image: the JPEG is {} x {}, its message says {} x {}; dropped",
                     size ? size->width : 0, size ? size->height : 0, in->width(), in->height());
  }
  JpegImage image;
  image.stamp = stampFromNanoseconds(in->stamp_ns());
  image.seq = in->seq();
  image.frame = in->frame();
  image.width = static_cast<int>(in->width());
  image.height = static_cast<int>(in->height());
  image.jpeg.assign(in->jpeg().begin(), in->jpeg().end());
  return image;
}

}  // namespace kiln::wire
