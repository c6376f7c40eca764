#pragma once

#include <optional>
#include <string>
#include <vector>

#include "robot/drivers/lepton/codec/lepton_telemetry.h"

namespace kiln::lepton {

inline constexpr int kWidth = 160;
inline constexpr int kHeight = 120;
inline constexpr int kTelemetryRows = 2;  ///< footer rows of the 160 x 122 format

/// Pixels as the camera sent them, and its telemetry if there was any.
struct LeptonFrame {
  int width = kWidth;
  int height = kHeight;
  std::vector<std::uint16_t> counts;  ///< row-major, width * height
  std::optional<LeptonTelemetry> telemetry;
  std::size_t pages = 1;  ///< of its file; this is the first one
};

/// Splits a Y16 picture: 160 x 122 carries four telemetry lines (A, B | C, reserved) in its last
/// two rows, any other size none. Error: InvalidInput if the number of words does not fit the size;
/// else parseTelemetry's.
[[nodiscard]] Result<LeptonFrame> splitFrame(int width, int height,
                                             std::vector<std::uint16_t> words);

/// Why a frame cannot be read as temperatures, and what helps; empty: it can.
[[nodiscard]] std::string whyNoTemperatures(const LeptonFrame& frame);

/// The value type. Without telemetry nothing says that counts are temperatures: `tlinear` is false,
/// the frame can be looked at but not measured in. Stamp and seq are the caller's.
[[nodiscard]] ThermalImage toThermalImage(const LeptonFrame& frame);

}  // namespace kiln::lepton
