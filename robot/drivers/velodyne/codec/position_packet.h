#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "common/core/error.h"

namespace kiln::velodyne {

inline constexpr std::size_t kPositionPacketBytes = 512;  ///< UDP payload, port 8308

enum class PpsStatus : std::uint8_t { Absent = 0, Synchronising = 1, Locked = 2, Error = 3 };
[[nodiscard]] const char* toString(PpsStatus status);

/// The sensor's own report, about 147 times a second: it is alive, and how its clock is
/// disciplined.
struct PositionPacket {
  std::uint32_t timestamp_us = 0;  ///< since the full hour
  PpsStatus pps = PpsStatus::Absent;
  bool thermal_shutdown = false;  ///< newer firmware; the laser is off until it cooled down
  std::string nmea;               ///< sentence without CR LF; empty if no GPS is connected
  bool nmea_valid = false;        ///< checksum of the sentence holds
  std::optional<double> utc_s;    ///< seconds of the day from a valid GPRMC sentence
};

/// Error: Truncated for a wrong size, InvalidInput for a PPS status above 3. A broken sentence is
/// not an Error (the sensor forwards what the receiver sends): `nmea_valid` is false.
[[nodiscard]] Result<PositionPacket> parsePositionPacket(std::span<const std::uint8_t> payload);

}  // namespace kiln::velodyne
