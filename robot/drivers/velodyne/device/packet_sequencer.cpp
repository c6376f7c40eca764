#include "robot/drivers/velodyne/device/packet_sequencer.h"

#include <cmath>
#include <cstdlib>

#include "robot/drivers/velodyne/codec/vlp16_decoder.h"

namespace kiln::velodyne {
namespace {

constexpr std::size_t kHeldBack = 32;  // packets; what is later has lost its place
constexpr std::int64_t kLargestHole_us = 1'000'000;
constexpr std::int64_t kLatest_us = 50'000;  // behind the newest, to be merely late
constexpr Duration kSameCapture = std::chrono::seconds(1);

}  // namespace

void PacketSequencer::push(const Vlp16Packet& packet, std::vector<std::uint8_t> payload,
                           Duration captured) {
  flush_ = false;
  if (!newest_) return place(packet, std::move(payload), captured, 0);
  const std::int64_t d = elapsed_us(newest_->sensor_us, packet.timestamp_us);
  const std::int64_t time_us = newest_->time_us + d;
  if (d > 0 && d <= kLargestHole_us) return place(packet, std::move(payload), captured, time_us);
  const bool same_capture =
      captured - newest_->captured <= kSameCapture && newest_->captured - captured <= kSameCapture;
  if (same_capture && seen_.contains(time_us)) {
    ++counts_.doubles;
  } else if (same_capture && d < 0 && d >= -kLatest_us) {
    ++counts_.late;
    if (!popped_us_ || time_us > *popped_us_) insert(time_us, std::move(payload));
  } else {
    doubt(packet, std::move(payload), captured);
  }
}

void PacketSequencer::place(const Vlp16Packet& packet, std::vector<std::uint8_t> payload,
                            Duration captured, std::int64_t time_us) {
  dropCandidate();
  newest_ = Newest{packet.timestamp_us, time_us, captured};
  insert(time_us, std::move(payload));
}

void PacketSequencer::insert(std::int64_t time_us, std::vector<std::uint8_t> payload) {
  waiting_.emplace(time_us, std::move(payload));
  seen_.insert(time_us);
  seen_.erase(seen_.begin(), seen_.lower_bound(newest_->time_us - kLargestHole_us));
}

void PacketSequencer::doubt(const Vlp16Packet& packet, std::vector<std::uint8_t> payload,
                            Duration captured) {
  const std::int64_t d =
      candidate_ ? elapsed_us(candidate_->packet.timestamp_us, packet.timestamp_us) : 0;
  if (d <= 0 || d > kLargestHole_us) {
    dropCandidate();
    candidate_ = Candidate{packet, std::move(payload), captured};
    return;
  }
  ++counts_.jumps;
  Candidate first = std::move(*candidate_);
  candidate_.reset();
  const auto period_us = std::llround(Vlp16Decoder::packetPeriod_us(first.packet.mode));
  const std::int64_t time_us = newest_->time_us + period_us;
  place(first.packet, std::move(first.payload), first.captured, time_us);
  place(packet, std::move(payload), captured, time_us + d);
}

/// A packet on its own, from somewhere else in time.
void PacketSequencer::dropCandidate() {
  if (candidate_) ++counts_.late;
  candidate_.reset();
}

void PacketSequencer::finish() {
  dropCandidate();
  flush_ = true;
}

std::optional<SequencedPacket> PacketSequencer::pop() {
  if (waiting_.empty() || (!flush_ && waiting_.size() <= kHeldBack)) return std::nullopt;
  auto first = waiting_.extract(waiting_.begin());
  popped_us_ = first.key();
  return SequencedPacket{std::chrono::microseconds(first.key()), std::move(first.mapped())};
}

}  // namespace kiln::velodyne
