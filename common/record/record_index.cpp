#include "common/record/record_index.h"

#include <algorithm>
#include <limits>

#include "common/record/mcap_decode.h"
#include "common/record/printable.h"
#include "common/record/record_scan.h"
#include "common/record/time_line.h"

namespace kiln {
namespace {

constexpr std::uint64_t kMaxSummaryBytes = 128u << 20;  // a day of recording has about 100 MB
constexpr std::uint64_t kLatestTime = std::numeric_limits<std::int64_t>::max();

bool addChunk(RecordIndex& index, const mcap::ChunkIndex& c, std::uint64_t file_size) {
  if (c.start_time > c.end_time || c.end_time > kLatestTime) return false;
  if (c.offset > file_size || c.length > file_size - c.offset) return false;
  ChunkEntry entry{c.offset, c.length, c.start_time, c.end_time, {}, c.compression};
  for (const auto& [channel, offset] : c.message_index_offsets) entry.channels.push_back(channel);
  if (c.message_index_length > file_size) return false;
  entry.index_length = c.message_index_length;
  // A message index has 9 + 2 + 4 bytes and 16 a message.
  const std::uint64_t heads = 15 * entry.channels.size();
  if (c.message_index_length > heads) entry.messages = (c.message_index_length - heads) / 16;
  index.chunks.push_back(std::move(entry));
  return true;
}

/// @return false when the record does not fit: the summary is not to be trusted.
bool takeSummaryRecord(RecordIndex& index, const mcap::Record& record, std::uint64_t file_size) {
  switch (record.opcode) {
    case mcap::Opcode::Schema: {
      auto schema = mcap::decodeSchema(record.content);
      if (schema) index.schemas[schema->id] = std::move(*schema);
      return schema.has_value();
    }
    case mcap::Opcode::Channel: {
      auto channel = mcap::decodeChannel(record.content);
      if (channel) index.channels[channel->id] = std::move(*channel);
      return channel.has_value();
    }
    case mcap::Opcode::ChunkIndex: {
      const auto chunk = mcap::decodeChunkIndex(record.content);
      return chunk && addChunk(index, *chunk, file_size);
    }
    case mcap::Opcode::AttachmentIndex: {
      auto attachment = mcap::decodeAttachmentIndex(record.content);
      if (attachment) index.attachments.push_back(std::move(*attachment));
      return attachment.has_value();
    }
    case mcap::Opcode::Statistics: {
      auto statistics = mcap::decodeStatistics(record.content);
      if (statistics) index.message_counts = std::move(statistics->channel_message_counts);
      return statistics.has_value();
    }
    default:
      return true;  // summary offsets, and what later versions may add
  }
}

/// The records between chunks are few: is one of them a message?
bool looseMessages(const RandomFile& file, std::uint64_t at, std::uint64_t end) {
  while (at < end) {
    const auto bytes = file.read(at, mcap::kRecordHeadBytes);
    if (!bytes) return true;
    mcap::ByteReader in(*bytes);
    const auto opcode = static_cast<mcap::Opcode>(in.u8());
    const std::uint64_t length = in.u64();
    if (opcode == mcap::Opcode::Message || length > file.size()) return true;
    at += mcap::kRecordHeadBytes + length;
  }
  return false;
}

/// Does the index tell of all that is in the file? Channels and schemas of some writers stand in
/// the chunks alone, and so do messages beside the chunks.
bool describesAll(const RandomFile& file, const RecordIndex& index, std::uint64_t data_end) {
  const auto known = [&](std::uint16_t channel) { return index.channels.contains(channel); };
  for (const auto& [id, channel] : index.channels) {
    if (channel.schema_id != 0 && !index.schemas.contains(channel.schema_id)) return false;
  }
  for (const auto& [id, count] : index.message_counts)
    if (count > 0 && !known(id)) return false;
  std::vector<std::pair<std::uint64_t, std::uint64_t>> spans;
  for (const ChunkEntry& chunk : index.chunks) {
    if (chunk.channels.empty() && index.message_counts.empty()) return false;
    if (!std::all_of(chunk.channels.begin(), chunk.channels.end(), known)) return false;
    spans.emplace_back(chunk.offset, chunk.offset + chunk.length + chunk.index_length);
  }
  std::sort(spans.begin(), spans.end());
  std::uint64_t at = mcap::kMagic.size();
  for (const auto& [start, end] : spans) {
    if (start < at || looseMessages(file, at, start)) return false;
    at = end;
  }
  return !looseMessages(file, at, data_end);
}

/// The index as the file's own summary has it, `complete` if that is all of it; nullopt when there
/// is none or it is damaged.
std::optional<RecordIndex> readSummary(const RandomFile& file) {
  constexpr std::uint64_t kEnd = mcap::kRecordHeadBytes + mcap::kFooterBytes + 8;
  if (file.size() < mcap::kMagic.size() + kEnd) return std::nullopt;
  const auto end = file.read(file.size() - kEnd, kEnd);
  if (!end || !std::string_view(*end).ends_with(mcap::kMagic)) return std::nullopt;
  mcap::ByteReader in(*end);
  const auto record = mcap::nextRecord(in);
  if (!record || record->opcode != mcap::Opcode::Footer) return std::nullopt;
  const auto footer = mcap::decodeFooter(record->content);
  const std::uint64_t footer_start = file.size() - kEnd;
  if (!footer || footer->summary_start == 0 || footer->summary_start > footer_start ||
      footer_start - footer->summary_start > kMaxSummaryBytes) {
    return std::nullopt;
  }
  const auto summary = file.read(footer->summary_start, footer_start - footer->summary_start);
  if (!summary) return std::nullopt;
  const std::string_view before_crc(end->data(), mcap::kRecordHeadBytes + 16);
  if (footer->summary_crc != 0 &&
      footer->summary_crc != mcap::crc32(before_crc, mcap::crc32(*summary))) {
    return std::nullopt;
  }
  RecordIndex index;
  mcap::ByteReader records(*summary);
  while (const auto next = mcap::nextRecord(records)) {
    if (!takeSummaryRecord(index, *next, footer->summary_start)) return std::nullopt;
  }
  if (records.remaining() > 0) return std::nullopt;
  index.complete = !index.chunks.empty() && describesAll(file, index, footer->summary_start);
  return index;
}

}  // namespace

Result<RecordIndex> readIndex(const RandomFile& file) {
  if (file.size() == 0) {
    return makeError(ErrorCode::InvalidInput, "{}: empty: there is nothing in this recording",
                     file.path());
  }
  const auto magic = file.size() < mcap::kMagic.size() ? Result<std::string>{std::string{}}
                                                       : file.read(0, mcap::kMagic.size());
  if (!magic) return tl::make_unexpected(magic.error());
  if (*magic != mcap::kMagic) {
    return makeError(ErrorCode::InvalidInput,
                     "{}: not an MCAP recording (its first bytes are others)", file.path());
  }
  auto summary = readSummary(file);
  const bool trusted = summary && summary->complete;
  RecordIndex index = trusted ? std::move(*summary) : scanRecords(file);
  if (!trusted && summary) {  // what a damaged chunk would have described
    index.schemas.merge(summary->schemas);
    index.channels.merge(summary->channels);
  }
  const auto foreign = [](const ChunkEntry& c) {
    return !c.compression.empty() && c.compression != "zstd" && c.compression != "lz4";
  };
  if (!index.chunks.empty() && std::all_of(index.chunks.begin(), index.chunks.end(), foreign)) {
    return makeError(ErrorCode::InvalidInput,
                     "{}: compressed with {}; Kiln reads zstd, lz4 and none: convert it first "
                     "(mcap compress)",
                     file.path(), printable(index.chunks.front().compression));
  }
  std::stable_sort(index.chunks.begin(), index.chunks.end(),
                   [](const ChunkEntry& a, const ChunkEntry& b) {
                     return std::pair(a.start_time, a.offset) < std::pair(b.start_time, b.offset);
                   });
  findTimeLine(file, index);
  std::stable_sort(index.chunks.begin(), index.chunks.end(),
                   [](const ChunkEntry& a, const ChunkEntry& b) {
                     return std::pair(a.start_time, a.offset) < std::pair(b.start_time, b.offset);
                   });
  return index;
}

}  // namespace kiln
