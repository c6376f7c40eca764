#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "common/core/error.h"

namespace kiln::velodyne {

inline constexpr std::size_t kDataPacketBytes = 1206;  ///< UDP payload, port 2368
inline constexpr int kBlocks = 12;
inline constexpr int kLasers = 16;
inline constexpr int kAzimuthUnits = 36000;  ///< 0.01 deg a revolution

enum class ReturnMode : std::uint8_t { Strongest = 0x37, Last = 0x38, Dual = 0x39 };

struct Return {
  std::uint16_t distance = 0;  ///< 2 mm units; 0 = no return
  std::uint8_t reflectivity = 0;
};

/// One block: two firing sequences of 16 lasers each.
struct Block {
  std::uint16_t azimuth = 0;  ///< 0.01 deg, < kAzimuthUnits, at the first firing
  std::array<Return, 2 * kLasers> returns{};
};

/// One data packet of a VLP-16, as transmitted (VLP-16 manual, "Data packet structure"; little
/// endian). With ReturnMode::Dual the blocks 2i (last return) and 2i + 1 (strongest) belong to the
/// same firings.
struct Vlp16Packet {
  std::array<Block, kBlocks> blocks{};
  std::uint32_t timestamp_us = 0;  ///< since the full hour, of the first firing
  ReturnMode mode = ReturnMode::Strongest;
};

/// Bounds-checked parse of one payload.
/// Error: Truncated for a wrong size; VersionMismatch naming the sensor when it is another model's
/// packet; InvalidInput for bad block flags, an azimuth of 360 deg or more, an unknown return mode,
/// a time beyond the hour or dual-return blocks whose azimuths differ.
[[nodiscard]] Result<Vlp16Packet> parseVlp16Packet(std::span<const std::uint8_t> payload);

/// From a to b on the sensor's clock, which restarts at each full hour; within half an hour either
/// way.
[[nodiscard]] std::int64_t elapsed_us(std::uint32_t a, std::uint32_t b);

/// The inverse of parseVlp16Packet: the emulator's and the tests' side of the wire.
[[nodiscard]] std::array<std::uint8_t, kDataPacketBytes> encodeVlp16Packet(
    const Vlp16Packet& packet);

}  // namespace kiln::velodyne
