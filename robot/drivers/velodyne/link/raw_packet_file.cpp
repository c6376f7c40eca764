#include "robot/drivers/velodyne/link/raw_packet_file.h"

#include <algorithm>
#include <fstream>

#include "robot/drivers/velodyne/codec/vlp16_packet.h"

namespace kiln::velodyne {
namespace {

/// Bytes are looked at this far ahead for the next packet behind a stray one.
constexpr std::size_t kLookAhead = 64 * kDataPacketBytes;

class RawPacketFile final : public PacketFile {
 public:
  explicit RawPacketFile(std::string path) : path_(std::move(path)) {}
  Result<void> open();
  Result<std::optional<RecordedPacket>> next() override;
  Result<void> rewind() override { return open(); }
  const std::string& path() const override { return path_; }

 private:
  void fill(std::size_t bytes);
  [[nodiscard]] bool flagAt(std::size_t at) const {
    return at + 1 < buffer_.size() && buffer_[at] == 0xFF && buffer_[at + 1] == 0xEE;
  }
  [[nodiscard]] std::size_t strayBytes();

  std::string path_;
  std::ifstream in_;
  std::vector<std::uint8_t> buffer_;  ///< from the next packet on
  std::uint64_t packet_ = 0, at_ = 0;
};

Result<void> RawPacketFile::open() {
  in_ = std::ifstream(path_, std::ios::binary);
  buffer_.clear();
  packet_ = at_ = 0;
  if (!in_)
    return makeError(ErrorCode::NotFound,
                     "{}: cannot be opened; check the path and its permissions", path_);
  return {};
}

void RawPacketFile::fill(std::size_t bytes) {
  if (buffer_.size() >= bytes || !in_) return;
  const std::size_t had = buffer_.size();
  buffer_.resize(bytes);
  in_.read(reinterpret_cast<char*>(buffer_.data() + had),
           static_cast<std::streamsize>(bytes - had));
  buffer_.resize(had + static_cast<std::size_t>(in_.gcount()));
}

/// How many bytes to the next packet: 0 where one stands, or a damaged one of the right length.
std::size_t RawPacketFile::strayBytes() {
  fill(2 * kDataPacketBytes);
  if (flagAt(0) || flagAt(kDataPacketBytes) || buffer_.size() <= kDataPacketBytes) return 0;
  fill(kLookAhead);
  for (std::size_t at = 1; at + kDataPacketBytes <= buffer_.size(); ++at) {
    if (flagAt(at) && parseVlp16Packet(std::span(buffer_).subspan(at, kDataPacketBytes))) return at;
  }
  return buffer_.size();
}

Result<std::optional<RecordedPacket>> RawPacketFile::next() {
  const std::size_t stray = strayBytes();
  if (buffer_.empty()) return std::nullopt;
  const std::size_t size = stray > 0 ? stray : kDataPacketBytes;
  if (buffer_.size() < size) {
    return makeError(
        ErrorCode::Truncated,
        "{}: cut off in packet {} at byte {}: {} of {} bytes; copy or record the file again", path_,
        packet_ + 1, at_, buffer_.size(), kDataPacketBytes);
  }
  ++packet_;
  at_ += size;
  RecordedPacket out;
  const auto end = buffer_.begin() + static_cast<std::ptrdiff_t>(size);
  out.payload.assign(buffer_.begin(), end);
  buffer_.erase(buffer_.begin(), end);
  return out;
}

}  // namespace

Result<std::unique_ptr<PacketFile>> openRawPacketFile(const std::string& path) {
  auto file = std::make_unique<RawPacketFile>(path);
  if (auto ok = file->open(); !ok) return tl::make_unexpected(ok.error());
  return file;
}

}  // namespace kiln::velodyne
