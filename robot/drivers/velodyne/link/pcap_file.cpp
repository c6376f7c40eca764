#include "robot/drivers/velodyne/link/pcap_file.h"

#include "robot/drivers/velodyne/link/frame_file.h"
#include "robot/drivers/velodyne/link/udp_frame.h"

namespace kiln::velodyne {
namespace {

class PcapFile final : public PacketFile {
 public:
  explicit PcapFile(const std::string& path) : frames_(path) {}

  Result<void> open() {
    joiner_ = {};
    counts_ = {};
    first_ns_.reset();
    failed_.reset();
    return frames_.open();
  }
  Result<std::optional<RecordedPacket>> next() override;
  Result<void> rewind() override { return open(); }
  const std::string& path() const override { return frames_.path(); }
  LinkCounts counts() const override {
    LinkCounts out = counts_;
    out.incomplete = joiner_.incomplete();
    return out;
  }

 private:
  [[nodiscard]] std::optional<RecordedPacket> packetOf(const CapturedFrame& frame);

  FrameFile frames_;
  FragmentJoiner joiner_;
  LinkCounts counts_;
  std::optional<std::int64_t> first_ns_;
  std::optional<Error> failed_;
};

std::optional<RecordedPacket> PcapFile::packetOf(const CapturedFrame& frame) {
  const auto link = static_cast<LinkType>(frame.link);
  if (!isReadable(link)) {
    ++counts_.other_links;
    counts_.other_link = frame.link;
    return std::nullopt;
  }
  auto ip = ipv4PacketOf(link, frame.bytes, frame.wire_bytes);
  if (!ip) return std::nullopt;
  std::optional<std::vector<std::uint8_t>> joined;
  if (ip->fragment()) {
    joined = joiner_.add(*ip);
    if (!joined) return std::nullopt;
    ip->offset = 0;
    ip->more = false;
    ip->payload = *joined;
  }
  const auto datagram = udpDatagramOf(*ip);
  if (!datagram) return std::nullopt;
  if (!first_ns_) first_ns_ = frame.time_ns;
  return RecordedPacket{Duration{frame.time_ns - *first_ns_},
                        ip->source,
                        datagram->destination_port,
                        datagram->missing,
                        {datagram->payload.begin(), datagram->payload.end()}};
}

Result<std::optional<RecordedPacket>> PcapFile::next() {
  if (failed_) return tl::make_unexpected(*failed_);
  for (;;) {
    auto frame = frames_.next();
    if (!frame) {
      failed_ = frame.error();
      return tl::make_unexpected(*failed_);
    }
    if (!*frame) return std::nullopt;
    if (auto packet = packetOf(**frame)) return packet;
  }
}

}  // namespace

Result<std::unique_ptr<PacketFile>> openPcapFile(const std::string& path) {
  auto file = std::make_unique<PcapFile>(path);
  if (auto ok = file->open(); !ok) return tl::make_unexpected(ok.error());
  return file;
}

}  // namespace kiln::velodyne
