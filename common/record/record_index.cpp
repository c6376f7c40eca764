#include "common/record/record_index.h"

#include <algorithm>
#include <limits>

#include <zstd.h>

#include "common/record/mcap_decode.h"
#include "common/record/record_scan.h"

namespace kiln {
namespace {

constexpr std::uint64_t kMaxChunkBytes = 256u << 20;    // compressed or not
constexpr std::uint64_t kMaxSummaryBytes = 512u << 20;  // a day of recording has about 100 MB
constexpr std::uint64_t kLatestTime = std::numeric_limits<std::int64_t>::max();

bool addChunk(RecordIndex& index, const mcap::ChunkIndex& c, std::uint64_t file_size) {
  if (c.start_time > c.end_time || c.end_time > kLatestTime) return false;
  if (c.offset > file_size || c.length > file_size - c.offset) return false;
  ChunkEntry entry{c.offset, c.length, c.start_time, c.end_time, {}};
  for (const auto& [channel, offset] : c.message_index_offsets) entry.channels.push_back(channel);
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

/// The index as the file's own summary has it; nullopt when there is none or it is damaged.
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
  index.complete = true;
  mcap::ByteReader records(*summary);
  while (const auto next = mcap::nextRecord(records)) {
    if (!takeSummaryRecord(index, *next, footer->summary_start)) return std::nullopt;
  }
  // Without chunk indexes there is nothing to be had from a summary that a scan does not find too.
  if (records.remaining() > 0 || index.chunks.empty()) return std::nullopt;
  return index;
}

}  // namespace

Result<RecordIndex> readIndex(const RandomFile& file) {
  const auto magic = file.size() < mcap::kMagic.size() ? Result<std::string>{std::string{}}
                                                       : file.read(0, mcap::kMagic.size());
  if (!magic) return tl::make_unexpected(magic.error());
  if (*magic != mcap::kMagic) {
    return makeError(ErrorCode::InvalidInput,
                     "{}: not an MCAP recording (its first bytes are others)", file.path());
  }
  auto index = readSummary(file);
  if (!index) index = scanRecords(file);
  std::stable_sort(index->chunks.begin(), index->chunks.end(),
                   [](const ChunkEntry& a, const ChunkEntry& b) {
                     return std::pair(a.start_time, a.offset) < std::pair(b.start_time, b.offset);
                   });
  return std::move(*index);
}

Result<std::string> readChunk(const RandomFile& file, const ChunkEntry& chunk) {
  const auto damaged = [&](const char* why) {
    return makeError(ErrorCode::InvalidInput, "{}: the chunk at {} is damaged: {}", file.path(),
                     chunk.offset, why);
  };
  if (chunk.length > kMaxChunkBytes) return damaged("it claims to be larger than 256 MiB");
  const auto bytes = file.read(chunk.offset, chunk.length);
  if (!bytes) return bytes;
  mcap::ByteReader in(*bytes);
  const auto record = mcap::nextRecord(in);
  if (!record || record->opcode != mcap::Opcode::Chunk) return damaged("no chunk starts there");
  const auto content = mcap::decodeChunk(record->content);
  if (!content) return damaged("its lengths do not fit");
  if (content->uncompressed_size > kMaxChunkBytes) return damaged("it unpacks to over 256 MiB");
  std::string out;
  if (content->compression.empty()) {
    out = content->records;
  } else if (content->compression == "zstd") {
    out.resize(static_cast<std::size_t>(content->uncompressed_size));
    const std::size_t size =
        ZSTD_decompress(out.data(), out.size(), content->records.data(), content->records.size());
    if (ZSTD_isError(size) != 0) return damaged(ZSTD_getErrorName(size));
    out.resize(size);
  } else {
    return makeError(ErrorCode::InvalidInput,
                     "{}: compressed with '{}'; Kiln reads zstd and uncompressed recordings",
                     file.path(), content->compression);
  }
  if (out.size() != content->uncompressed_size) return damaged("it unpacks to another size");
  if (content->uncompressed_crc != 0 && content->uncompressed_crc != mcap::crc32(out))
    return damaged("its CRC does not match");
  return out;
}

}  // namespace kiln
