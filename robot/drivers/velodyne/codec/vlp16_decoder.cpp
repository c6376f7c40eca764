#include "robot/drivers/velodyne/codec/vlp16_decoder.h"

#include <algorithm>
#include <cmath>

#include "common/core/units.h"

namespace kiln::velodyne {
namespace {

constexpr double kUnit_m = 0.002;
// 1200 rpm turn 0.80 deg a block; more means that packets or blocks are missing in between.
constexpr int kLargestGap = 100;
constexpr std::array<double, kLasers> kRise_mm{11.2, -0.7, 9.7, -2.2, 8.1, -3.7, 6.6, -5.1,
                                               5.1,  -6.6, 3.7, -8.1, 2.2, -9.7, 0.7, -11.2};

constexpr std::uint8_t ringOf(int laser) {
  return static_cast<std::uint8_t>(
      (Vlp16Decoder::kElevation_deg[static_cast<std::size_t>(laser)] + 15) / 2);
}

}  // namespace

Vlp16Decoder::Vlp16Decoder(Config config)
    : config_(config), cos_azimuth_(kAzimuthUnits), sin_azimuth_(kAzimuthUnits) {
  for (std::size_t i = 0; i < kLasers; ++i) {
    const double elevation = kElevation_deg[i] * kDeg;
    cos_elevation_[i] = static_cast<float>(std::cos(elevation));
    sin_elevation_[i] = static_cast<float>(std::sin(elevation));
    rise_m_[i] = config.vertical_correction ? static_cast<float>(kRise_mm[i] * 1e-3) : 0.0f;
  }
  for (std::size_t i = 0; i < kAzimuthUnits; ++i) {
    cos_azimuth_[i] = static_cast<float>(std::cos(static_cast<double>(i) * M_PI / 18000));
    sin_azimuth_[i] = static_cast<float>(std::sin(static_cast<double>(i) * M_PI / 18000));
  }
}

double Vlp16Decoder::packetPeriod_us(ReturnMode mode) {
  return kBlock_us * (mode == ReturnMode::Dual ? kBlocks / 2 : kBlocks);
}

int Vlp16Decoder::gapAfter(const Vlp16Packet& packet, std::size_t block, std::size_t next) {
  if (next < kBlocks) {
    const int gap = (packet.blocks[next].azimuth - packet.blocks[block].azimuth + kAzimuthUnits) %
                    kAzimuthUnits;
    if (gap <= kLargestGap) last_gap_ = gap;
  }
  return last_gap_;
}

void Vlp16Decoder::decode(const Vlp16Packet& packet, Decoded& out) {
  out.points.clear();
  out.sequences.clear();
  const bool dual = packet.mode == ReturnMode::Dual;
  const std::size_t step = dual ? 2 : 1;
  for (std::size_t b = 0; b < kBlocks; b += step) {
    const int gap = gapAfter(packet, b, b + step);
    for (int half = 0; half < 2; ++half) {
      const double time_us =
          kSequence_us * static_cast<double>(2 * (b / step) + static_cast<std::size_t>(half));
      FiringSequence sequence;
      sequence.first = out.points.size();
      sequence.time_us = static_cast<float>(time_us);
      sequence.azimuth = static_cast<std::uint16_t>(
          static_cast<int>(packet.blocks[b].azimuth + std::lround(gap * 0.5 * half)) %
          kAzimuthUnits);
      decodeSequence(packet.blocks[b], half, gap, time_us, nullptr, out);
      if (dual) decodeSequence(packet.blocks[b + 1], half, gap, time_us, &packet.blocks[b], out);
      sequence.count = out.points.size() - sequence.first;
      out.sequences.push_back(sequence);
    }
  }
}

/// @param same_firing  the other return of a dual pair: an equal distance is the same echo and is
/// dropped.
void Vlp16Decoder::decodeSequence(const Block& block, int half, int gap, double time_us,
                                  const Block* same_firing, Decoded& out) const {
  for (int laser = 0; laser < kLasers; ++laser) {
    const std::size_t k = static_cast<std::size_t>(half * kLasers + laser);
    const Return& echo = block.returns[k];
    if (echo.distance == 0) continue;
    if (same_firing != nullptr && same_firing->returns[k].distance == echo.distance) continue;
    const double range = echo.distance * kUnit_m;
    if (range < config_.min_range_m || range > config_.max_range_m) continue;
    const double within = kSequence_us * half + kFiring_us * laser;
    const double turned = gap * within / kBlock_us;
    const double whole = std::floor(turned);
    const auto azimuth =
        static_cast<std::size_t>(block.azimuth + static_cast<int>(whole)) % kAzimuthUnits;
    // Table plus first order: at 50 m a whole table step would be 9 mm.
    const float rest = static_cast<float>((turned - whole) * M_PI / 18000);
    const float sine = sin_azimuth_[azimuth] + rest * cos_azimuth_[azimuth];
    const float cosine = cos_azimuth_[azimuth] - rest * sin_azimuth_[azimuth];
    const auto l = static_cast<std::size_t>(laser);
    const float flat = static_cast<float>(range) * cos_elevation_[l];
    out.points.push_back({flat * cosine, -flat * sine,
                          static_cast<float>(range) * sin_elevation_[l] + rise_m_[l],
                          echo.reflectivity, ringOf(laser), static_cast<std::uint16_t>(azimuth),
                          static_cast<float>(time_us + kFiring_us * laser)});
  }
}

}  // namespace kiln::velodyne
