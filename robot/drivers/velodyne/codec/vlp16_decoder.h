#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "robot/drivers/velodyne/codec/vlp16_packet.h"

namespace kiln::velodyne {

/// One measured point, in the `lidar` frame (X forward = the sensor's Y, Y left = the sensor's -X,
/// Z up).
struct DecodedPoint {
  float x, y, z;           ///< metres
  std::uint8_t intensity;  ///< 0-100 diffuse, 101-255 retro-reflector
  std::uint8_t ring;       ///< 0 lowest .. 15 highest laser
  std::uint16_t azimuth;   ///< 0.01 deg, interpolated and rounded down
  float time_us;           ///< after the packet's timestamp
};

/// The points of one firing sequence (16 lasers, 55.296 us), in firing order; without those that
/// saw nothing.
struct FiringSequence {
  std::uint16_t azimuth = 0;         ///< 0.01 deg, of laser 0
  float time_us = 0;                 ///< after the packet's timestamp
  std::size_t first = 0, count = 0;  ///< range in Decoded::points
};

struct Decoded {
  std::vector<DecodedPoint> points;
  std::vector<FiringSequence> sequences;
};

/// Packets to points: per-point time, azimuth interpolated for each single firing, vertical origin
/// correction. Remembers the azimuth step of the previous packet for a last block that has no
/// successor. Thread-compatible.
class Vlp16Decoder {
 public:
  struct Config {
    bool vertical_correction =
        true;  ///< lasers leave the sensor up to 11 mm above or below its centre (newer manuals)
    double min_range_m = 0.3;  ///< nearer returns are the housing
    double max_range_m = 131.07;
  };
  explicit Vlp16Decoder(Config config);
  /// @pre packet comes from parseVlp16Packet. Overwrites `out`, whose capacity is kept.
  void decode(const Vlp16Packet& packet, Decoded& out);
  void reset() { last_gap_ = kTypicalGap; }

  static constexpr double kSequence_us = 55.296;
  static constexpr double kFiring_us = 2.304;
  static constexpr double kBlock_us = 110.592;
  /// Time that a packet's 24 (single) or 12 (dual return) firing sequences take.
  [[nodiscard]] static double packetPeriod_us(ReturnMode mode);
  /// Elevation of a laser by its firing order, degrees.
  static constexpr std::array<int, kLasers> kElevation_deg{-15, 1, -13, 3,  -11, 5,  -9, 7,
                                                           -7,  9, -5,  11, -3,  13, -1, 15};

 private:
  static constexpr int kTypicalGap = 40;  ///< 0.01 deg a block at 10 Hz
  [[nodiscard]] int gapAfter(const Vlp16Packet& packet, std::size_t block, std::size_t next);
  void decodeSequence(const Block& block, int half, int gap, double time_us,
                      const Block* same_firing, Decoded& out) const;

  Config config_;
  int last_gap_ = kTypicalGap;
  std::array<float, kLasers> cos_elevation_{}, sin_elevation_{}, rise_m_{};
  std::vector<float> cos_azimuth_, sin_azimuth_;  ///< table over 0.01 deg
};

}  // namespace kiln::velodyne
