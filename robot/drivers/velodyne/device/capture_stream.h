#pragma once

#include <compare>
#include <memory>

#include "robot/drivers/velodyne/device/packet_sequencer.h"
#include "robot/drivers/velodyne/link/packet_file.h"

namespace kiln::velodyne {

/// One sensor of a capture: by its address and the port that it sends to.
struct SensorKey {
  std::uint32_t address = 0;  ///< IPv4; 0: not known
  std::uint16_t port = kDataPort;
  auto operator<=>(const SensorKey&) const = default;
};
/// "192.168.1.201", with ":2369" if it is not the usual port; "the sensor" without an address.
[[nodiscard]] std::string toString(const SensorKey& sensor);

/// The data packets of one sensor out of a file, in order and without doubles; everything else is
/// passed over. Thread-compatible.
class CaptureStream {
 public:
  CaptureStream(PacketFile& file, SensorKey sensor) : file_(file), sensor_(sensor) {}
  /// nullopt at the end. Error: the file's.
  [[nodiscard]] Result<std::optional<SequencedPacket>> next();
  Result<void> rewind();
  [[nodiscard]] const SequenceCounts& counts() const { return sequencer_.counts(); }

 private:
  PacketFile& file_;
  SensorKey sensor_;
  PacketSequencer sequencer_;
};

}  // namespace kiln::velodyne
