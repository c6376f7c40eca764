#pragma once

#include "robot/drivers/velodyne/codec/position_packet.h"
#include "robot/drivers/velodyne/codec/scan_assembler.h"
#include "robot/drivers/velodyne/device/capture_stream.h"

namespace kiln::velodyne {

/// Packets on the data port that are no data packets of this sensor, by what is wrong with them.
struct Refusals {
  std::uint64_t cut = 0;          ///< by the capture's snap length
  std::uint64_t other_size = 0;   ///< another number of bytes
  std::uint64_t other_model = 0;  ///< another sensor's
  std::uint64_t damaged = 0;
  std::string first_cut, first_size, first_model, first_damage;  ///< what the first said
  [[nodiscard]] std::uint64_t total() const { return cut + other_size + other_model + damaged; }
  /// What the first of the most frequent kind said.
  [[nodiscard]] const std::string& mostFrequent() const;
};

/// What a recording holds.
struct CaptureSummary {
  SensorKey sensor;                 ///< which is played: the one with the most data packets
  std::uint64_t data_packets = 0;   ///< of it
  std::uint64_t other_sensors = 0;  ///< data packets of further ones; not played
  std::uint64_t position_packets = 0;
  std::uint64_t other_packets = 0;  ///< UDP to other ports
  Refusals refused;
  SequenceCounts sequence;
  LinkCounts link;
  Duration longest_pause{};  ///< by the capture's clock, between two packets; over a second, else 0
  ScanStatistics scan;
  ReturnMode mode = ReturnMode::Strongest;  ///< of the first packet
  std::optional<PositionPacket> position;   ///< the last one
  Duration length{};                        ///< by the sensor's clock, without jumps
};

/// What is missing or was left out, in one line: "6 packets lost, 1 refused (...)"; empty if all is
/// well.
[[nodiscard]] std::string defectsOf(const CaptureSummary& summary);

/// Reads the whole file and leaves it at its start. Packets that are no data packets are counted
/// and passed over. Error: the file's own (cut off), Degenerate when there is no data packet (with
/// what stands in its place) or not one full revolution.
[[nodiscard]] Result<CaptureSummary> checkCapture(PacketFile& file,
                                                  const ScanAssembler::Config& config);

}  // namespace kiln::velodyne
