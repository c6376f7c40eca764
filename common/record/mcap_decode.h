#pragma once

#include <optional>

#include "common/record/mcap_format.h"

/// Decoders take the content of a record (without opcode and length) and answer nullopt when a
/// length in it does not fit. Views point into the input.
namespace kiln::mcap {

/// Reads little-endian values; a read beyond the end yields zero and makes ok() false for good.
class ByteReader {
 public:
  explicit ByteReader(std::string_view bytes) : rest_(bytes) {}
  [[nodiscard]] bool ok() const { return ok_; }
  [[nodiscard]] std::size_t remaining() const { return rest_.size(); }
  [[nodiscard]] std::uint8_t u8() { return static_cast<std::uint8_t>(number(1)); }
  [[nodiscard]] std::uint16_t u16() { return static_cast<std::uint16_t>(number(2)); }
  [[nodiscard]] std::uint32_t u32() { return static_cast<std::uint32_t>(number(4)); }
  [[nodiscard]] std::uint64_t u64() { return number(8); }
  [[nodiscard]] std::string_view take(std::uint64_t size);
  [[nodiscard]] std::string_view text() { return take(u32()); }
  void fail() { ok_ = false; }  ///< what was read makes no sense

 private:
  [[nodiscard]] std::uint64_t number(std::size_t bytes);
  std::string_view rest_;
  bool ok_ = true;
};

struct Record {
  Opcode opcode = Opcode::Header;
  std::string_view content;
};
/// The next record of a sequence; nullopt at its end and where it is cut off.
[[nodiscard]] std::optional<Record> nextRecord(ByteReader& in);

[[nodiscard]] std::optional<Header> decodeHeader(std::string_view content);
[[nodiscard]] std::optional<Footer> decodeFooter(std::string_view content);
[[nodiscard]] std::optional<Schema> decodeSchema(std::string_view content);
[[nodiscard]] std::optional<Channel> decodeChannel(std::string_view content);
[[nodiscard]] std::optional<Message> decodeMessage(std::string_view content);
[[nodiscard]] std::optional<Chunk> decodeChunk(std::string_view content);
[[nodiscard]] std::optional<MessageIndex> decodeMessageIndex(std::string_view content);
[[nodiscard]] std::optional<ChunkIndex> decodeChunkIndex(std::string_view content);
/// Also nullopt when the attachment's CRC does not match.
[[nodiscard]] std::optional<Attachment> decodeAttachment(std::string_view content);
[[nodiscard]] std::optional<AttachmentIndex> decodeAttachmentIndex(std::string_view content);
[[nodiscard]] std::optional<Statistics> decodeStatistics(std::string_view content);

}  // namespace kiln::mcap
