#include "common/record/mcap_decode.h"

#include "common/record/mcap_fields.h"

namespace kiln::mcap {
namespace {

template <class T>
std::optional<T> whole(const ByteReader& in, T value) {
  if (!in.ok()) return std::nullopt;
  return value;
}

void get(ByteReader& in, std::uint16_t& out) { out = in.u16(); }
void get(ByteReader& in, std::uint32_t& out) { out = in.u32(); }
void get(ByteReader& in, std::uint64_t& out) { out = in.u64(); }
void get(ByteReader& in, std::string& out) { out = in.text(); }

/// Maps and lists.
template <class Pairs>
requires requires { typename Pairs::value_type::second_type; }
void get(ByteReader& in, Pairs& out) {
  ByteReader body(in.text());
  while (body.remaining() > 0) {
    std::remove_const_t<typename Pairs::value_type::first_type> first{};
    typename Pairs::value_type::second_type second{};
    get(body, first);
    get(body, second);
    if (!body.ok()) return in.fail();
    out.insert(out.end(), typename Pairs::value_type(std::move(first), std::move(second)));
  }
}

template <class Record>
Record getFields(ByteReader& in) {
  Record record;
  std::apply([&](auto&... field) { (get(in, field), ...); }, fields(record));
  return record;
}

template <class Record>
std::optional<Record> decoded(std::string_view content) {
  ByteReader in(content);
  return whole(in, getFields<Record>(in));
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

std::optional<Header> decodeHeader(std::string_view content) { return decoded<Header>(content); }
std::optional<Footer> decodeFooter(std::string_view content) { return decoded<Footer>(content); }
std::optional<Schema> decodeSchema(std::string_view content) { return decoded<Schema>(content); }
std::optional<Channel> decodeChannel(std::string_view content) { return decoded<Channel>(content); }
std::optional<MessageIndex> decodeMessageIndex(std::string_view content) {
  return decoded<MessageIndex>(content);
}
std::optional<ChunkIndex> decodeChunkIndex(std::string_view content) {
  return decoded<ChunkIndex>(content);
}
std::optional<AttachmentIndex> decodeAttachmentIndex(std::string_view content) {
  return decoded<AttachmentIndex>(content);
}
std::optional<Statistics> decodeStatistics(std::string_view content) {
  return decoded<Statistics>(content);
}

std::optional<Message> decodeMessage(std::string_view content) {
  ByteReader in(content);
  auto r = getFields<Message>(in);
  r.data = in.take(in.remaining());
  return whole(in, r);
}

std::optional<Chunk> decodeChunk(std::string_view content) {
  ByteReader in(content);
  auto r = getFields<Chunk>(in);
  r.records = in.take(in.u64());
  return whole(in, std::move(r));
}

std::optional<Attachment> decodeAttachment(std::string_view content) {
  ByteReader in(content);
  auto r = getFields<Attachment>(in);
  r.data = in.take(in.u64());
  const std::size_t covered = content.size() - in.remaining();
  const std::uint32_t crc = in.u32();
  if (in.ok() && crc != 0 && crc != crc32(content.substr(0, covered))) return std::nullopt;
  return whole(in, std::move(r));
}

}  // namespace kiln::mcap
