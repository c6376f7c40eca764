#pragma once

#include <cmath>
#include <vector>

#include "robot/drivers/velodyne/codec/vlp16_decoder.h"

namespace kiln::velodyne::testing {

/// A sensor that turns at `rpm` and sees everything at `distance` (2 mm units).
struct SyntheticSensor {
  double rpm = 600;
  std::uint16_t distance = 1000;  // 2 m
  std::uint32_t time_us = 1000;
  double azimuth = 0.0;  // 0.01 deg
  ReturnMode mode = ReturnMode::Strongest;

  [[nodiscard]] Vlp16Packet next() {
    Vlp16Packet packet;
    packet.mode = mode;
    packet.timestamp_us = time_us;
    const double per_block = rpm / 60.0 * kAzimuthUnits * Vlp16Decoder::kBlock_us * 1e-6;
    const std::size_t step = mode == ReturnMode::Dual ? 2 : 1;
    for (std::size_t b = 0; b < kBlocks; b += step) {
      for (std::size_t twin = 0; twin < step; ++twin) {
        Block& block = packet.blocks[b + twin];
        block.azimuth = static_cast<std::uint16_t>(azimuth);
        for (auto& echo : block.returns)
          echo = {static_cast<std::uint16_t>(distance + 500 * twin), 50};
      }
      azimuth = std::fmod(azimuth + per_block, kAzimuthUnits);
    }
    time_us += static_cast<std::uint32_t>(std::lround(Vlp16Decoder::packetPeriod_us(mode)));
    return packet;
  }
};

}  // namespace kiln::velodyne::testing
