#include "robot/drivers/velodyne/device/capture_check.h"

namespace kiln::velodyne {
namespace {

Result<void> addPacket(const RecordedPacket& packet, const std::string& path,
                       ScanAssembler& assembler, CaptureSummary& summary) {
  if (packet.port == kPositionPort) {
    ++summary.position_packets;
    if (auto position = parsePositionPacket(packet.payload)) summary.position = *position;
    return {};
  }
  if (packet.port != kDataPort) {
    ++summary.other_packets;
    return {};
  }
  ++summary.data_packets;
  if (const auto fed = assembler.feed(packet.payload, Stamp{packet.time}); !fed) {
    return tl::make_unexpected(Error{
        fed.error().code,
        fmt::format("{}: data packet {}: {}", path, summary.data_packets, fed.error().message)});
  }
  if (summary.data_packets == 1) {
    if (const auto parsed = parseVlp16Packet(packet.payload)) summary.mode = parsed->mode;
  }
  return {};
}

}  // namespace

Result<CaptureSummary> checkCapture(PacketFile& file, const ScanAssembler::Config& config) {
  CaptureSummary summary;
  ScanAssembler assembler(config);
  for (;;) {
    auto packet = file.next();
    if (!packet) return tl::make_unexpected(packet.error());
    if (!packet->has_value()) break;
    if (auto ok = addPacket(**packet, file.path(), assembler, summary); !ok)
      return tl::make_unexpected(ok.error());
    summary.length = std::max(summary.length, (*packet)->time);
  }
  summary.scan = assembler.statistics();
  if (summary.data_packets == 0) {
    return makeError(ErrorCode::Degenerate,
                     "{}: holds no LiDAR data packet (UDP port {}); record the sensor's traffic, "
                     "e.g. tcpdump udp port {}",
                     file.path(), kDataPort, kDataPort);
  }
  if (summary.scan.revolutions == 0) {
    return makeError(ErrorCode::Degenerate,
                     "{}: {} data packets are less than one full revolution; record at least 0.3 s",
                     file.path(), summary.data_packets);
  }
  if (auto ok = file.rewind(); !ok) return tl::make_unexpected(ok.error());
  return summary;
}

}  // namespace kiln::velodyne
