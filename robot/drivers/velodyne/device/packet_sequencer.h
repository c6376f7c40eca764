#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <vector>

#include "common/core/stamp.h"
#include "robot/drivers/velodyne/codec/vlp16_packet.h"

namespace kiln::velodyne {

/// What the sequencer did to the packets.
struct SequenceCounts {
  std::uint64_t doubles = 0;  ///< came twice; dropped
  std::uint64_t late = 0;   ///< behind a younger one; put where it belongs, or dropped if too late
  std::uint64_t jumps = 0;  ///< the sensor's clock jumped, or nothing came for over a second
};

/// A data packet in its place.
struct SequencedPacket {
  Duration time{};  ///< by the sensor's clock, since its first packet; a jump takes one period
  std::vector<std::uint8_t> payload;
};

/// Puts the packets of one sensor into the order of the sensor's own clock, whatever the capture's
/// clock says. A clock that jumps is believed when the next packet follows from there; then it goes
/// on at once. Memory is bounded. Thread-compatible.
class PacketSequencer {
 public:
  /// @param captured  by the capture's clock: tells a repeat from the same minute an hour later.
  void push(const Vlp16Packet& packet, std::vector<std::uint8_t> payload, Duration captured);
  /// Nothing follows: what is held back comes out of pop().
  void finish();
  /// The next packet; nullopt until more is pushed.
  [[nodiscard]] std::optional<SequencedPacket> pop();
  [[nodiscard]] const SequenceCounts& counts() const { return counts_; }

 private:
  struct Newest {
    std::uint32_t sensor_us = 0;
    std::int64_t time_us = 0;
    Duration captured{};
  };
  struct Candidate {
    Vlp16Packet packet;
    std::vector<std::uint8_t> payload;
    Duration captured;
  };
  void place(const Vlp16Packet& packet, std::vector<std::uint8_t> payload, Duration captured,
             std::int64_t time_us);
  void insert(std::int64_t time_us, std::vector<std::uint8_t> payload);
  void doubt(const Vlp16Packet& packet, std::vector<std::uint8_t> payload, Duration captured);
  void dropCandidate();

  SequenceCounts counts_;
  std::optional<Newest> newest_;
  std::optional<Candidate> candidate_;  ///< its time does not follow from newest_
  std::map<std::int64_t, std::vector<std::uint8_t>> waiting_;  ///< by time
  std::set<std::int64_t> seen_;                                ///< times of the last second
  std::optional<std::int64_t> popped_us_;
  bool flush_ = false;
};

}  // namespace kiln::velodyne
