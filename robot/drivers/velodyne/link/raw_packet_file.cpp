#include "robot/drivers/velodyne/link/raw_packet_file.h"

#include <fstream>

#include "robot/drivers/velodyne/codec/vlp16_decoder.h"

namespace kiln::velodyne {
namespace {

constexpr std::int64_t kHour_us = 3'600'000'000;

class RawPacketFile final : public PacketFile {
 public:
  explicit RawPacketFile(std::string path) : path_(std::move(path)) {}
  Result<void> open();
  Result<std::optional<RecordedPacket>> next() override;
  Result<void> rewind() override { return open(); }
  const std::string& path() const override { return path_; }

 private:
  [[nodiscard]] Duration timeOf(const std::vector<std::uint8_t>& payload);

  std::string path_;
  std::ifstream in_;
  std::uint64_t packet_ = 0;
  Duration time_{};
  std::optional<std::uint32_t> last_us_;
};

Result<void> RawPacketFile::open() {
  in_ = std::ifstream(path_, std::ios::binary);
  packet_ = 0;
  time_ = Duration{};
  last_us_.reset();
  if (!in_)
    return makeError(ErrorCode::NotFound,
                     "{}: cannot be opened; check the path and its permissions", path_);
  return {};
}

/// Time by the sensor's own clock; a packet that is not a VLP-16's gets its predecessor's (the
/// decoder refuses it).
Duration RawPacketFile::timeOf(const std::vector<std::uint8_t>& payload) {
  const auto packet = parseVlp16Packet(payload);
  if (!packet) return time_;
  if (last_us_) {
    std::int64_t d = static_cast<std::int64_t>(packet->timestamp_us) - *last_us_;
    if (d < -kHour_us / 2) d += kHour_us;
    const std::int64_t period =
        static_cast<std::int64_t>(Vlp16Decoder::packetPeriod_us(packet->mode));
    if (d < 0 || d > 1'000'000) d = period;  // joined recordings: go on at once
    time_ += std::chrono::microseconds(d);
  }
  last_us_ = packet->timestamp_us;
  return time_;
}

Result<std::optional<RecordedPacket>> RawPacketFile::next() {
  RecordedPacket out;
  out.payload.resize(kDataPacketBytes);
  in_.read(reinterpret_cast<char*>(out.payload.data()),
           static_cast<std::streamsize>(kDataPacketBytes));
  const auto got = static_cast<std::size_t>(in_.gcount());
  if (got == 0) return std::nullopt;
  if (got < kDataPacketBytes) {
    return makeError(
        ErrorCode::Truncated,
        "{}: cut off in packet {} at byte {}: {} of {} bytes; copy or record the file again", path_,
        packet_ + 1, packet_ * kDataPacketBytes, got, kDataPacketBytes);
  }
  ++packet_;
  out.time = timeOf(out.payload);
  return out;
}

}  // namespace

Result<std::unique_ptr<PacketFile>> openRawPacketFile(const std::string& path) {
  auto file = std::make_unique<RawPacketFile>(path);
  if (auto ok = file->open(); !ok) return tl::make_unexpected(ok.error());
  return file;
}

}  // namespace kiln::velodyne
