#include "common/record/foxglove.h"

#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <optional>

#include "common/geom/frames.h"
#include "common/wire/jpeg_size.h"
#include "common/wire/proto_message.h"
#include "foxglove/CompressedImage.pb.h"
#include "foxglove/FrameTransforms.pb.h"
#include "foxglove/Log.pb.h"
#include "foxglove/PointCloud.pb.h"
#include "foxglove/PoseInFrame.pb.h"
#include "foxglove/RawImage.pb.h"

namespace kiln::foxglove {
namespace {

static_assert(std::endian::native == std::endian::little, "packed elements are little-endian");

using Field = ::foxglove::PackedElementField;

constexpr std::size_t kStride = 18;
constexpr std::uint32_t kMaxStride = 1024;
constexpr std::size_t kMaxPoints = 4'000'000;
constexpr std::int64_t kNanoseconds = 1'000'000'000;

template <class Timestamp>
void setTime(Stamp stamp, Timestamp& out) {
  out.set_seconds(toNanoseconds(stamp) / kNanoseconds);
  out.set_nanos(static_cast<std::int32_t>(toNanoseconds(stamp) % kNanoseconds));
}

template <class Timestamp>
Stamp timeOf(const Timestamp& in) {
  constexpr std::int64_t kMostSeconds = 9'000'000'000;  // beyond it nanoseconds overflow
  if (in.seconds() < 0 || in.seconds() > kMostSeconds) return {};
  return stampFromNanoseconds(in.seconds() * kNanoseconds + in.nanos());
}

void set(const Eigen::Vector3d& p, ::foxglove::Vector3& out) {
  out.set_x(p.x());
  out.set_y(p.y());
  out.set_z(p.z());
}

void set(const Eigen::Quaterniond& q, ::foxglove::Quaternion& out) {
  out.set_x(q.x());
  out.set_y(q.y());
  out.set_z(q.z());
  out.set_w(q.w());
}

void addField(::foxglove::PointCloud& cloud, const char* name, std::uint32_t offset,
              Field::NumericType type) {
  Field& field = *cloud.add_fields();
  field.set_name(name);
  field.set_offset(offset);
  field.set_type(type);
}

float rounded(float value, float step) {
  return std::isfinite(value) ? std::nearbyint(value / step) * step : value;
}

/// Where a field of `type` lies in an element of `stride` bytes; nullopt if there is none that
/// fits.
std::optional<std::size_t> offsetOf(const ::foxglove::PointCloud& cloud, const char* name,
                                    Field::NumericType type, std::size_t size) {
  for (const Field& field : cloud.fields()) {
    if (field.name() != name || field.type() != type) continue;
    if (field.offset() > cloud.point_stride() || size > cloud.point_stride() - field.offset())
      return std::nullopt;
    return field.offset();
  }
  return std::nullopt;
}

}  // namespace

std::string encode(const PointCloud& cloud) {
  ::foxglove::PointCloud out;
  setTime(cloud.stamp, *out.mutable_timestamp());
  out.set_frame_id(cloud.frame);
  out.mutable_pose()->mutable_orientation()->set_w(1.0);
  out.mutable_pose()->mutable_position();
  out.set_point_stride(kStride);
  addField(out, "x", 0, Field::FLOAT32);
  addField(out, "y", 4, Field::FLOAT32);
  addField(out, "z", 8, Field::FLOAT32);
  addField(out, "intensity", 12, Field::UINT8);
  addField(out, "ring", 13, Field::UINT8);
  addField(out, "time", 14, Field::FLOAT32);
  std::string& data = *out.mutable_data();
  data.resize(cloud.size() * kStride);
  char* to = data.data();
  for (std::size_t i = 0; i < cloud.size(); ++i, to += kStride) {
    const std::array<float, 3> xyz{rounded(cloud.x[i], kCloudStep_m),
                                   rounded(cloud.y[i], kCloudStep_m),
                                   rounded(cloud.z[i], kCloudStep_m)};
    std::memcpy(to, xyz.data(), 12);
    to[12] = static_cast<char>(cloud.intensity[i]);
    to[13] = static_cast<char>(cloud.ring[i]);
    const float time_s = rounded(cloud.time_offset_s[i], kCloudTimeStep_s);
    std::memcpy(to + 14, &time_s, 4);
  }
  return out.SerializeAsString();
}

Result<PointCloud> decodePointCloud(std::string_view bytes) {
  ::foxglove::PointCloud in;
  if (!in.ParseFromArray(bytes.data(), static_cast<int>(bytes.size())))
    return makeError(ErrorCode::InvalidInput, "point cloud: {} bytes cannot be parsed",
                     bytes.size());
  const std::size_t stride = in.point_stride();
  const auto x = offsetOf(in, "x", Field::FLOAT32, 4), y = offsetOf(in, "y", Field::FLOAT32, 4),
             z = offsetOf(in, "z", Field::FLOAT32, 4);
  if (stride == 0 || stride > kMaxStride || in.data().size() / stride > kMaxPoints || !x || !y ||
      !z) {
    return makeError(ErrorCode::InvalidInput,
                     "point cloud: {} bytes of {} a point without x, y, z as float32",
                     in.data().size(), stride);
  }
  const auto intensity = offsetOf(in, "intensity", Field::UINT8, 1);
  const auto ring = offsetOf(in, "ring", Field::UINT8, 1);
  const auto time = offsetOf(in, "time", Field::FLOAT32, 4);
  PointCloud cloud;
  cloud.stamp = timeOf(in.timestamp());
  cloud.frame = in.frame_id();
  const std::size_t n = in.data().size() / stride;
  cloud.reserve(n);
  for (std::size_t i = 0; i < n; ++i) {
    const char* from = in.data().data() + i * stride;
    const auto number = [from](std::size_t offset) {
      float value = 0;
      std::memcpy(&value, from + offset, 4);
      return value;
    };
    cloud.push(number(*x), number(*y), number(*z),
               intensity ? static_cast<std::uint8_t>(from[*intensity]) : std::uint8_t{0},
               ring ? static_cast<std::uint8_t>(from[*ring]) : std::uint8_t{0},
               time ? number(*time) : 0.0f);
  }
  return cloud;
}

std::string encode(const ThermalImage& image) {
  ::foxglove::RawImage out;
  setTime(image.stamp, *out.mutable_timestamp());
  out.set_frame_id(frames::kThermal);
  out.set_width(static_cast<std::uint32_t>(image.width));
  out.set_height(static_cast<std::uint32_t>(image.height));
  out.set_encoding("mono16");
  out.set_step(static_cast<std::uint32_t>(image.width) * 2);
  out.set_data(image.counts.data(), image.counts.size() * 2);
  return out.SerializeAsString();
}

std::string encode(const JpegImage& image) {
  ::foxglove::CompressedImage out;
  setTime(image.stamp, *out.mutable_timestamp());
  out.set_frame_id(image.frame);
  out.set_format("jpeg");
  out.set_data(image.jpeg.data(), image.jpeg.size());
  return out.SerializeAsString();
}

Result<JpegImage> decodeCompressedImage(std::string_view bytes) {
  ::foxglove::CompressedImage in;
  if (!in.ParseFromArray(bytes.data(), static_cast<int>(bytes.size())))
    return makeError(ErrorCode::InvalidInput, "picture: {} bytes cannot be parsed", bytes.size());
  const auto size = jpegSize(in.data());
  if (!size) {
    return makeError(ErrorCode::InvalidInput, "picture: {} bytes of format '{}' are not a JPEG",
                     in.data().size(), in.format());
  }
  JpegImage image;
  image.stamp = timeOf(in.timestamp());
  image.frame = in.frame_id();
  image.width = size->width;
  image.height = size->height;
  image.jpeg.assign(in.data().begin(), in.data().end());
  return image;
}

std::string encode(const LogLine& line) {
  using Out = ::foxglove::Log;
  constexpr std::array<Out::Level, 6> kLevels{Out::DEBUG,   Out::DEBUG, Out::INFO,
                                              Out::WARNING, Out::ERROR, Out::FATAL};
  Out out;
  setTime(line.stamp, *out.mutable_timestamp());
  const bool known = line.level >= 0 && line.level < static_cast<int>(kLevels.size());
  out.set_level(known ? kLevels[static_cast<std::size_t>(line.level)] : Out::UNKNOWN);
  out.set_message(validUtf8(line.text));
  out.set_name(validUtf8(line.logger));
  return out.SerializeAsString();
}

std::string encode(std::span<const FrameTransform> transforms) {
  ::foxglove::FrameTransforms out;
  for (const FrameTransform& transform : transforms) {
    ::foxglove::FrameTransform& row = *out.add_transforms();
    setTime(transform.stamp, *row.mutable_timestamp());
    row.set_parent_frame_id(transform.parent);
    row.set_child_frame_id(transform.child);
    set(Eigen::Vector3d(transform.X_parent_child.translation()), *row.mutable_translation());
    set(Eigen::Quaterniond(transform.X_parent_child.linear()), *row.mutable_rotation());
  }
  return out.SerializeAsString();
}

std::string encodePose(Stamp stamp, const std::string& frame,
                       const Eigen::Isometry3d& X_frame_body) {
  ::foxglove::PoseInFrame out;
  setTime(stamp, *out.mutable_timestamp());
  out.set_frame_id(frame);
  set(Eigen::Vector3d(X_frame_body.translation()), *out.mutable_pose()->mutable_position());
  set(Eigen::Quaterniond(X_frame_body.linear()), *out.mutable_pose()->mutable_orientation());
  return out.SerializeAsString();
}

}  // namespace kiln::foxglove
