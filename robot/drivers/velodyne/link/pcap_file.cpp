#include "robot/drivers/velodyne/link/pcap_file.h"

#include <array>

#include <pcap/pcap.h>

#include "robot/drivers/velodyne/link/udp_frame.h"

namespace kiln::velodyne {
namespace {

struct PcapClose {
  void operator()(pcap_t* handle) const { pcap_close(handle); }
};
using PcapHandle = std::unique_ptr<pcap_t, PcapClose>;

class PcapFile final : public PacketFile {
 public:
  explicit PcapFile(std::string path) : path_(std::move(path)) {}

  Result<void> open();
  Result<std::optional<RecordedPacket>> next() override;
  Result<void> rewind() override { return open(); }
  const std::string& path() const override { return path_; }

 private:
  std::string path_;
  PcapHandle handle_;
  LinkType link_ = LinkType::Ethernet;
  std::uint64_t packet_ = 0;
  std::optional<std::int64_t> first_ns_;
  std::optional<Error> failed_;
};

Result<void> PcapFile::open() {
  std::array<char, PCAP_ERRBUF_SIZE> why{};
  handle_.reset(pcap_open_offline_with_tstamp_precision(path_.c_str(), PCAP_TSTAMP_PRECISION_NANO,
                                                        why.data()));
  packet_ = 0;
  first_ns_.reset();
  failed_.reset();
  if (handle_ == nullptr) {
    return makeError(ErrorCode::InvalidInput,
                     "{}: not a readable capture ({}); record it again with tcpdump -w", path_,
                     why.data());
  }
  const int link = pcap_datalink(handle_.get());
  switch (link) {
    case DLT_EN10MB:
      link_ = LinkType::Ethernet;
      return {};
    case DLT_LINUX_SLL:
      link_ = LinkType::LinuxCooked;
      return {};
    case DLT_RAW:
      link_ = LinkType::RawIp;
      return {};
    default:
      return makeError(ErrorCode::InvalidInput,
                       "{}: capture has link type {}; needed is Ethernet, Linux cooked or raw IP",
                       path_, link);
  }
}

Result<std::optional<RecordedPacket>> PcapFile::next() {
  if (failed_) return tl::make_unexpected(*failed_);
  for (;;) {
    const long offset = std::ftell(pcap_file(handle_.get()));
    pcap_pkthdr* header = nullptr;
    const u_char* bytes = nullptr;
    const int rc = pcap_next_ex(handle_.get(), &header, &bytes);
    if (rc == PCAP_ERROR_BREAK) return std::nullopt;
    if (rc != 1) {
      failed_ = Error{
          ErrorCode::Truncated,
          fmt::format(
              "{}: cut off or damaged in packet {} at byte {} ({}); copy or record the file again",
              path_, packet_ + 1, offset, pcap_geterr(handle_.get()))};
      return tl::make_unexpected(*failed_);
    }
    ++packet_;
    if (header->caplen < header->len) {
      failed_ = Error{
          ErrorCode::Truncated,
          fmt::format(
              "{}: packet {} at byte {} was captured with {} of its {} bytes; record with a snap "
              "length of at least 1248 (tcpdump -s 0)",
              path_, packet_, offset, header->caplen, header->len)};
      return tl::make_unexpected(*failed_);
    }
    const auto datagram = udpDatagramOf(link_, {bytes, header->caplen});
    if (!datagram) continue;
    const std::int64_t ns =
        static_cast<std::int64_t>(header->ts.tv_sec) * 1'000'000'000 + header->ts.tv_usec;
    if (!first_ns_) first_ns_ = ns;
    return RecordedPacket{Duration{ns - *first_ns_},
                          datagram->destination_port,
                          {datagram->payload.begin(), datagram->payload.end()}};
  }
}

}  // namespace

Result<std::unique_ptr<PacketFile>> openPcapFile(const std::string& path) {
  auto file = std::make_unique<PcapFile>(path);
  if (auto ok = file->open(); !ok) return tl::make_unexpected(ok.error());
  return file;
}

}  // namespace kiln::velodyne
