#pragma once

#include <cstdint>
#include <span>

#include "common/core/error.h"
#include "common/model/sensor.h"

namespace kiln::lepton {

inline constexpr std::size_t kTelemetryWords = 240;  ///< lines A, B and C of 80 words

/// What the camera says about a frame (Lepton telemetry, revision 0x000E; word numbers in hardware
/// notes section 3).
struct LeptonTelemetry {
  std::uint16_t revision = 0;       ///< word 0
  std::uint32_t uptime_ms = 0;      ///< 1-2
  bool agc = false;                 ///< 3-4, bit 12
  FfcState ffc = FfcState::Never;   ///< 3-4, bits 4-5
  bool ffc_desired = false;         ///< bit 3
  bool over_temperature = false;    ///< bit 20
  std::uint32_t frame_counter = 0;  ///< 20-21
  std::uint16_t frame_mean = 0;     ///< 22
  double fpa_k = 0.0;               ///< 24: focal plane array
  double housing_k = 0.0;           ///< 26
  bool tlinear = false;             ///< 208
  double kelvin_per_count = 0.01;   ///< 209: 1 -> 0.01 K, 0 -> 0.1 K
};

/// Error: Truncated for fewer than 240 words; VersionMismatch for revision 0 (no telemetry in these
/// words); InvalidInput for a TLinear flag or resolution that is neither 0 nor 1.
[[nodiscard]] Result<LeptonTelemetry> parseTelemetry(std::span<const std::uint16_t> words);

}  // namespace kiln::lepton
