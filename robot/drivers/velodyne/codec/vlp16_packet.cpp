#include "robot/drivers/velodyne/codec/vlp16_packet.h"

#include <string>

namespace kiln::velodyne {
namespace {

constexpr std::size_t kBlockBytes = 100;
constexpr std::size_t kTimeOffset = kBlocks * kBlockBytes;
constexpr std::size_t kModeOffset = kTimeOffset + 4;
constexpr std::size_t kProductOffset = kTimeOffset + 5;
constexpr std::uint8_t kProductVlp16 = 0x22;
constexpr std::uint16_t kBlockFlag = 0xEEFF;  // bytes FF EE
constexpr std::uint32_t kHour_us = 3'600'000'000u;

std::uint16_t u16(std::span<const std::uint8_t> bytes, std::size_t at) {
  return static_cast<std::uint16_t>(bytes[at] | bytes[at + 1] << 8);
}
std::uint32_t u32(std::span<const std::uint8_t> bytes, std::size_t at) {
  return static_cast<std::uint32_t>(u16(bytes, at)) | static_cast<std::uint32_t>(u16(bytes, at + 2))
                                                          << 16;
}

/// Factory byte 2 of the vendor's other sensors, for the message.
std::string productName(std::uint8_t product) {
  switch (product) {
    case 0x21:
      return "an HDL-32E";
    case 0x24:
      return "a Puck Hi-Res";
    case 0x28:
      return "a VLP-32C";
    case 0x31:
      return "a Velarray";
    case 0xA1:
      return "a VLS-128";
    default:
      return "an unknown sensor";
  }
}

Result<void> checkPacket(const Vlp16Packet& packet) {
  for (int b = 0; b < kBlocks; ++b) {
    if (packet.blocks[static_cast<std::size_t>(b)].azimuth >= kAzimuthUnits) {
      return makeError(ErrorCode::InvalidInput,
                       "block {} has azimuth {:.2f} deg; a VLP-16 packet has 0 to 359.99", b,
                       packet.blocks[static_cast<std::size_t>(b)].azimuth / 100.0);
    }
  }
  if (packet.timestamp_us >= kHour_us) {
    return makeError(ErrorCode::InvalidInput, "packet time is {} us after the hour; an hour has {}",
                     packet.timestamp_us, kHour_us);
  }
  if (packet.mode != ReturnMode::Dual) return {};
  for (std::size_t b = 0; b < kBlocks; b += 2) {
    if (packet.blocks[b].azimuth != packet.blocks[b + 1].azimuth) {
      return makeError(
          ErrorCode::InvalidInput,
          "dual-return blocks {} and {} have azimuths {:.2f} and {:.2f} deg; they must be equal", b,
          b + 1, packet.blocks[b].azimuth / 100.0, packet.blocks[b + 1].azimuth / 100.0);
    }
  }
  return {};
}

}  // namespace

Result<Vlp16Packet> parseVlp16Packet(std::span<const std::uint8_t> payload) {
  if (payload.size() != kDataPacketBytes) {
    return makeError(ErrorCode::Truncated, "data packet has {} bytes; a VLP-16 packet has {}",
                     payload.size(), kDataPacketBytes);
  }
  if (payload[kProductOffset] != kProductVlp16) {
    return makeError(ErrorCode::VersionMismatch,
                     "packet is from {} (product 0x{:02X}); this input needs a VLP-16",
                     productName(payload[kProductOffset]), payload[kProductOffset]);
  }
  Vlp16Packet packet;
  switch (payload[kModeOffset]) {
    case 0x37:
      packet.mode = ReturnMode::Strongest;
      break;
    case 0x38:
      packet.mode = ReturnMode::Last;
      break;
    case 0x39:
      packet.mode = ReturnMode::Dual;
      break;
    default:
      return makeError(
          ErrorCode::InvalidInput,
          "packet has return mode 0x{:02X}; known are 0x37 strongest, 0x38 last, 0x39 dual",
          payload[kModeOffset]);
  }
  packet.timestamp_us = u32(payload, kTimeOffset);
  for (std::size_t b = 0; b < kBlocks; ++b) {
    const std::size_t at = b * kBlockBytes;
    if (u16(payload, at) != kBlockFlag) {
      return makeError(ErrorCode::InvalidInput,
                       "block {} starts with {:02X} {:02X} instead of FF EE", b, payload[at],
                       payload[at + 1]);
    }
    Block& block = packet.blocks[b];
    block.azimuth = u16(payload, at + 2);
    for (std::size_t k = 0; k < block.returns.size(); ++k) {
      block.returns[k] = {u16(payload, at + 4 + 3 * k), payload[at + 6 + 3 * k]};
    }
  }
  if (auto ok = checkPacket(packet); !ok) return tl::make_unexpected(ok.error());
  return packet;
}

std::int64_t elapsed_us(std::uint32_t a, std::uint32_t b) {
  const std::int64_t d = static_cast<std::int64_t>(b) - a;
  if (d < -std::int64_t{kHour_us} / 2) return d + kHour_us;
  return d > std::int64_t{kHour_us} / 2 ? d - kHour_us : d;
}

std::array<std::uint8_t, kDataPacketBytes> encodeVlp16Packet(const Vlp16Packet& packet) {
  std::array<std::uint8_t, kDataPacketBytes> out{};
  const auto put16 = [&out](std::size_t at, std::uint32_t value) {
    out[at] = static_cast<std::uint8_t>(value);
    out[at + 1] = static_cast<std::uint8_t>(value >> 8);
  };
  for (std::size_t b = 0; b < kBlocks; ++b) {
    const std::size_t at = b * kBlockBytes;
    put16(at, kBlockFlag);
    put16(at + 2, packet.blocks[b].azimuth);
    for (std::size_t k = 0; k < packet.blocks[b].returns.size(); ++k) {
      put16(at + 4 + 3 * k, packet.blocks[b].returns[k].distance);
      out[at + 6 + 3 * k] = packet.blocks[b].returns[k].reflectivity;
    }
  }
  put16(kTimeOffset, packet.timestamp_us);
  put16(kTimeOffset + 2, packet.timestamp_us >> 16);
  out[kModeOffset] = static_cast<std::uint8_t>(packet.mode);
  out[kProductOffset] = kProductVlp16;
  return out;
}

}  // namespace kiln::velodyne
