#include "common/record/mcap_decode.h"

namespace kiln::mcap {
namespace {

template <class T>
std::optional<T> whole(const ByteReader& in, T value) {
  if (!in.ok()) return std::nullopt;
  return value;
}

std::map<std::uint16_t, std::uint64_t> counts(ByteReader& in) {
  std::map<std::uint16_t, std::uint64_t> out;
  ByteReader body(in.text());
  while (body.ok() && body.remaining() > 0) {
    const std::uint16_t key = body.u16();
    const std::uint64_t value = body.u64();
    if (body.ok()) out[key] = value;
  }
  return out;
}

}  // namespace

std::string_view ByteReader::take(std::uint64_t size) {
  if (!ok_ || size > rest_.size()) {
    ok_ = false;
    rest_ = {};
    return {};
  }
  const std::string_view out = rest_.substr(0, static_cast<std::size_t>(size));
  rest_.remove_prefix(static_cast<std::size_t>(size));
  return out;
}

std::uint64_t ByteReader::number(std::size_t bytes) {
  const std::string_view raw = take(bytes);
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < raw.size(); ++i) {
    value |= std::uint64_t{static_cast<std::uint8_t>(raw[i])} << (8 * i);
  }
  return value;
}

std::optional<Record> nextRecord(ByteReader& in) {
  if (in.remaining() < kRecordHeadBytes) return std::nullopt;
  Record record;
  record.opcode = static_cast<Opcode>(in.u8());
  record.content = in.take(in.u64());
  return whole(in, record);
}

std::optional<Header> decodeHeader(std::string_view content) {
  ByteReader in(content);
  Header r;
  r.profile = in.text();
  r.library = in.text();
  return whole(in, std::move(r));
}

std::optional<Footer> decodeFooter(std::string_view content) {
  ByteReader in(content);
  Footer r;
  r.summary_start = in.u64();
  r.summary_offset_start = in.u64();
  r.summary_crc = in.u32();
  return whole(in, r);
}

std::optional<Schema> decodeSchema(std::string_view content) {
  ByteReader in(content);
  Schema r;
  r.id = in.u16();
  r.name = in.text();
  r.encoding = in.text();
  r.data = in.text();
  return whole(in, std::move(r));
}

std::optional<Channel> decodeChannel(std::string_view content) {
  ByteReader in(content);
  Channel r;
  r.id = in.u16();
  r.schema_id = in.u16();
  r.topic = in.text();
  r.message_encoding = in.text();
  ByteReader metadata(in.text());
  while (metadata.ok() && metadata.remaining() > 0) {
    const std::string key(metadata.text());
    r.metadata[key] = metadata.text();
  }
  if (!metadata.ok()) return std::nullopt;
  return whole(in, std::move(r));
}

std::optional<Message> decodeMessage(std::string_view content) {
  ByteReader in(content);
  Message r;
  r.channel_id = in.u16();
  r.sequence = in.u32();
  r.log_time = in.u64();
  r.publish_time = in.u64();
  r.data = in.take(in.remaining());
  return whole(in, r);
}

std::optional<Chunk> decodeChunk(std::string_view content) {
  ByteReader in(content);
  Chunk r;
  r.start_time = in.u64();
  r.end_time = in.u64();
  r.uncompressed_size = in.u64();
  r.uncompressed_crc = in.u32();
  r.compression = in.text();
  r.records = in.take(in.u64());
  return whole(in, std::move(r));
}

std::optional<MessageIndex> decodeMessageIndex(std::string_view content) {
  ByteReader in(content);
  MessageIndex r;
  r.channel_id = in.u16();
  ByteReader entries(in.text());
  while (entries.ok() && entries.remaining() > 0) {
    const std::uint64_t log_time = entries.u64();
    const std::uint64_t offset = entries.u64();
    if (entries.ok()) r.entries.emplace_back(log_time, offset);
  }
  if (!entries.ok()) return std::nullopt;
  return whole(in, std::move(r));
}

std::optional<ChunkIndex> decodeChunkIndex(std::string_view content) {
  ByteReader in(content);
  ChunkIndex r;
  r.start_time = in.u64();
  r.end_time = in.u64();
  r.offset = in.u64();
  r.length = in.u64();
  r.message_index_offsets = counts(in);
  r.message_index_length = in.u64();
  r.compression = in.text();
  r.compressed_size = in.u64();
  r.uncompressed_size = in.u64();
  return whole(in, std::move(r));
}

std::optional<Attachment> decodeAttachment(std::string_view content) {
  ByteReader in(content);
  Attachment r;
  r.log_time = in.u64();
  r.create_time = in.u64();
  r.name = in.text();
  r.media_type = in.text();
  r.data = in.take(in.u64());
  const std::size_t covered = content.size() - in.remaining();
  const std::uint32_t crc = in.u32();
  if (in.ok() && crc != 0 && crc != crc32(content.substr(0, covered))) return std::nullopt;
  return whole(in, std::move(r));
}

std::optional<AttachmentIndex> decodeAttachmentIndex(std::string_view content) {
  ByteReader in(content);
  AttachmentIndex r;
  r.offset = in.u64();
  r.length = in.u64();
  r.log_time = in.u64();
  r.create_time = in.u64();
  r.data_size = in.u64();
  r.name = in.text();
  r.media_type = in.text();
  return whole(in, std::move(r));
}

std::optional<Statistics> decodeStatistics(std::string_view content) {
  ByteReader in(content);
  Statistics r;
  r.message_count = in.u64();
  r.schema_count = in.u16();
  r.channel_count = in.u32();
  r.attachment_count = in.u32();
  r.metadata_count = in.u32();
  r.chunk_count = in.u32();
  r.start_time = in.u64();
  r.end_time = in.u64();
  r.channel_message_counts = counts(in);
  return whole(in, std::move(r));
}

}  // namespace kiln::mcap
