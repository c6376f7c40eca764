#pragma once

#include <span>
#include <string>
#include <string_view>

#include "common/core/error.h"
#include "common/model/sensor.h"
#include "common/model/status.h"

/// model <-> the well-known foxglove.* message layouts (proto/foxglove), as bytes of one message:
/// what Foxglove, Lichtblick, Rerun and PlotJuggler show as it is.
namespace kiln::foxglove {

/// Coordinates are rounded to the range resolution of a VLP-16 (2 mm, so by at most 1 mm) and times
/// to 4 us, two firings of its lasers: the zero bits behind them compress.
inline constexpr float kCloudStep_m = 1.0f / 512.0f;
inline constexpr float kCloudTimeStep_s = 1.0f / (1 << 18);

/// Fields x y z (float32, m), intensity and ring (uint8), time (float32, s after the stamp).
[[nodiscard]] std::string encode(const PointCloud& cloud);
/// Takes clouds of other writers too, as long as they have x, y and z as float32; what else is
/// missing becomes zero. `seq` is not in the message. Error: InvalidInput.
[[nodiscard]] Result<PointCloud> decodePointCloud(std::string_view bytes);

/// RawImage "mono16" of the camera's counts (with TLinear: hundredths of a kelvin), frame
/// `thermal`.
[[nodiscard]] std::string encode(const ThermalImage& image);
/// CompressedImage "jpeg": the picture's own bytes.
[[nodiscard]] std::string encode(const JpegImage& image);
/// Width and height are read from the JPEG. Error: InvalidInput.
[[nodiscard]] Result<JpegImage> decodeCompressedImage(std::string_view bytes);
[[nodiscard]] std::string encode(const LogLine& line);

struct FrameTransform {
  Stamp stamp;
  std::string parent, child;  ///< frames.h words
  Eigen::Isometry3d X_parent_child = Eigen::Isometry3d::Identity();
};
[[nodiscard]] std::string encode(std::span<const FrameTransform> transforms);
/// PoseInFrame.
[[nodiscard]] std::string encodePose(Stamp stamp, const std::string& frame,
                                     const Eigen::Isometry3d& X_frame_body);

}  // namespace kiln::foxglove
