#include "robot/drivers/velodyne/device/capture_stream.h"

namespace kiln::velodyne {

std::string toString(const SensorKey& sensor) {
  const std::uint32_t a = sensor.address;
  const std::string host =
      a == 0 ? std::string("the sensor")
             : fmt::format("{}.{}.{}.{}", a >> 24, a >> 16 & 255, a >> 8 & 255, a & 255);
  return sensor.port == kDataPort ? host : fmt::format("{}:{}", host, sensor.port);
}

Result<std::optional<SequencedPacket>> CaptureStream::next() {
  for (;;) {
    if (auto ready = sequencer_.pop()) return ready;
    auto packet = file_.next();
    if (!packet) return tl::make_unexpected(packet.error());
    if (!*packet) {
      sequencer_.finish();
      return sequencer_.pop();
    }
    RecordedPacket& read = **packet;
    if (SensorKey{read.source, read.port} != sensor_ || read.missing > 0) continue;
    if (const auto parsed = parseVlp16Packet(read.payload))
      sequencer_.push(*parsed, std::move(read.payload), read.time);
  }
}

Result<void> CaptureStream::rewind() {
  sequencer_ = {};
  return file_.rewind();
}

}  // namespace kiln::velodyne
