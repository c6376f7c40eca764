#include "robot/drivers/velodyne/codec/scan_assembler.h"

#include <cmath>

#include "common/geom/frames.h"

namespace kiln::velodyne {
namespace {

constexpr double kLargestHole_us = 1e6;
constexpr std::size_t kTypicalPoints = 30000;
// Sensor time is trusted between packets; every packet lets the mapping creep towards a late
// arrival by this much, so that a slow sensor clock (tens of ppm) is followed without importing the
// network's jitter.
constexpr Duration kCreep{200};

}  // namespace

ScanAssembler::ScanAssembler(Config config) : config_(config), decoder_(config.decoder) {}

void ScanAssembler::restart() {
  scan_.reset();
  last_time_us_.reset();
  last_stamp_.reset();
  last_relative_.reset();
  decoder_.reset();
}

void ScanAssembler::countLoss(const Vlp16Packet& packet) {
  if (!last_time_us_) return;
  const auto d = static_cast<double>(elapsed_us(*last_time_us_, packet.timestamp_us));
  if (d <= 0 || d > kLargestHole_us) {
    ++statistics_.restarts;
    restart();
    return;
  }
  const double missing = std::round(d / Vlp16Decoder::packetPeriod_us(packet.mode)) - 1.0;
  if (missing > 0) statistics_.lost += static_cast<std::uint64_t>(missing);
}

Stamp ScanAssembler::packetStamp(const Vlp16Packet& packet, Stamp received_at) {
  Stamp stamp = received_at;
  if (last_time_us_ && last_stamp_) {
    const Stamp by_sensor =
        *last_stamp_ + std::chrono::microseconds(elapsed_us(*last_time_us_, packet.timestamp_us)) +
        kCreep;
    stamp = std::min(received_at, by_sensor);
  }
  last_time_us_ = packet.timestamp_us;
  last_stamp_ = stamp;
  return stamp;
}

PointCloudPtr ScanAssembler::finishRevolution(Stamp at) {
  PointCloudPtr done;
  if (scan_ != nullptr) {
    ++statistics_.revolutions;
    statistics_.rpm = 60.0 / toSeconds(at - scan_start_);
    done = std::move(scan_);
  }
  scan_ = std::make_shared<PointCloud>();
  scan_->reserve(kTypicalPoints);
  scan_->frame = frames::kLidar;
  scan_->stamp = at;
  scan_->seq = statistics_.revolutions;
  scan_start_ = at;
  return done;
}

Result<PointCloudPtr> ScanAssembler::feed(std::span<const std::uint8_t> payload,
                                          Stamp received_at) {
  const auto packet = parseVlp16Packet(payload);
  if (!packet) {
    ++statistics_.refused;
    return tl::make_unexpected(packet.error());
  }
  ++statistics_.packets;
  countLoss(*packet);
  const Stamp start = packetStamp(*packet, received_at);
  decoder_.decode(*packet, decoded_);
  PointCloudPtr done;
  for (const FiringSequence& sequence : decoded_.sequences) {
    const int relative = (sequence.azimuth - config_.cut_azimuth + kAzimuthUnits) % kAzimuthUnits;
    const bool passed_cut = last_relative_ && relative < *last_relative_ - kAzimuthUnits / 2;
    last_relative_ = relative;
    const Stamp at = start + fromSeconds(sequence.time_us * 1e-6);
    if (passed_cut) {
      if (PointCloudPtr revolution = finishRevolution(at)) done = std::move(revolution);
    }
    if (scan_ == nullptr) continue;
    const auto base_s = static_cast<float>(toSeconds(start - scan_->stamp));
    for (std::size_t i = sequence.first; i < sequence.first + sequence.count; ++i) {
      const DecodedPoint& p = decoded_.points[i];
      scan_->push(p.x, p.y, p.z, p.intensity, p.ring, base_s + p.time_us * 1e-6f);
    }
  }
  return done;
}

}  // namespace kiln::velodyne
