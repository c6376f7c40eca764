#include "robot/drivers/velodyne/codec/position_packet.h"

#include <charconv>
#include <vector>

namespace kiln::velodyne {
namespace {

constexpr std::size_t kTimeOffset = 0xC6;
constexpr std::size_t kPpsOffset = 0xCA;
constexpr std::size_t kThermalOffset = 0xCB;
constexpr std::size_t kNmeaOffset = 0xCE;
constexpr std::size_t kNmeaBytes = 128;

std::string sentence(std::span<const std::uint8_t> field) {
  std::string out;
  for (const std::uint8_t byte : field) {
    if (byte == 0 || byte == '\r' || byte == '\n') break;
    out.push_back(static_cast<char>(byte));
  }
  return out;
}

/// "$....*HH": HH is the XOR of everything between.
bool checksumHolds(const std::string& nmea) {
  const std::size_t star = nmea.rfind('*');
  if (nmea.empty() || nmea[0] != '$' || star == std::string::npos || star + 3 != nmea.size())
    return false;
  unsigned char sum = 0;
  for (std::size_t i = 1; i < star; ++i)
    sum = static_cast<unsigned char>(sum ^ static_cast<unsigned char>(nmea[i]));
  unsigned stated = 0;
  const auto [end, ec] =
      std::from_chars(nmea.data() + star + 1, nmea.data() + nmea.size(), stated, 16);
  return ec == std::errc{} && end == nmea.data() + nmea.size() && stated == sum;
}

/// hhmmss[.ss] of "$GPRMC,hhmmss.ss,...".
std::optional<double> utcOf(const std::string& nmea) {
  const std::size_t first = nmea.find(',');
  if (first == std::string::npos || nmea.compare(0, first, "$GPRMC") != 0) return std::nullopt;
  const std::string field = nmea.substr(first + 1, nmea.find(',', first + 1) - first - 1);
  double value = 0;
  const auto [end, ec] = std::from_chars(field.data(), field.data() + field.size(), value);
  if (ec != std::errc{} || end != field.data() + field.size() || !(value >= 0 && value < 240000))
    return std::nullopt;
  const int hhmm = static_cast<int>(value / 100);
  return hhmm / 100 * 3600 + hhmm % 100 * 60 + (value - 100.0 * hhmm);
}

}  // namespace

const char* toString(PpsStatus status) {
  switch (status) {
    case PpsStatus::Absent:
      return "absent";
    case PpsStatus::Synchronising:
      return "synchronising";
    case PpsStatus::Locked:
      return "locked";
    case PpsStatus::Error:
      return "error";
  }
  return "unknown";
}

Result<PositionPacket> parsePositionPacket(std::span<const std::uint8_t> payload) {
  if (payload.size() != kPositionPacketBytes) {
    return makeError(ErrorCode::Truncated,
                     "position packet has {} bytes; a VLP-16 position packet has {}",
                     payload.size(), kPositionPacketBytes);
  }
  if (payload[kPpsOffset] > 3) {
    return makeError(ErrorCode::InvalidInput, "position packet has PPS status {}; known are 0 to 3",
                     payload[kPpsOffset]);
  }
  PositionPacket out;
  for (int i = 3; i >= 0; --i) {
    out.timestamp_us = out.timestamp_us << 8 | payload[kTimeOffset + static_cast<std::size_t>(i)];
  }
  out.pps = static_cast<PpsStatus>(payload[kPpsOffset]);
  out.thermal_shutdown = payload[kThermalOffset] != 0;
  out.nmea = sentence(payload.subspan(kNmeaOffset, kNmeaBytes));
  out.nmea_valid = checksumHolds(out.nmea);
  if (out.nmea_valid) out.utc_s = utcOf(out.nmea);
  return out;
}

}  // namespace kiln::velodyne
