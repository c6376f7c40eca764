#pragma once

#include <string>
#include <string_view>

#include "common/core/error.h"
#include "common/model/sensor.h"

/// model <-> sensor.proto, as bytes of one message. Decoders take anything and answer corrupt input
/// with an Error.
namespace kiln::wire {

/// @pre as packCloud (cloud_codec.h).
[[nodiscard]] std::string encode(const PointCloud& cloud, double resolution_m);
[[nodiscard]] std::string encode(const ThermalImage& image);
/// JPEG bytes go through untouched.
[[nodiscard]] std::string encode(const JpegImage& image);

[[nodiscard]] Result<PointCloud> decodeCloud(std::string_view bytes);
[[nodiscard]] Result<ThermalImage> decodeThermal(std::string_view bytes);
[[nodiscard]] Result<JpegImage> decodeJpeg(std::string_view bytes);

}  // namespace kiln::wire
