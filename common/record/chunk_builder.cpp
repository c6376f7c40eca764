#include "common/record/chunk_builder.h"

#include <algorithm>

#include "common/core/check.h"
#include "common/record/mcap_encode.h"

namespace kiln {

ChunkBuilder::ChunkBuilder(int zstd_level) : zstd_level_(zstd_level), zstd_(ZSTD_createCCtx()) {}

void ChunkBuilder::add(const mcap::Message& message) {
  start_time_ = empty() ? message.log_time : std::min(start_time_, message.log_time);
  end_time_ = empty() ? message.log_time : std::max(end_time_, message.log_time);
  mcap::MessageIndex& index = indexes_[message.channel_id];
  index.channel_id = message.channel_id;
  index.entries.emplace_back(message.log_time, records_.size());
  mcap::append(records_, message);
}

ChunkBuilder::Closed ChunkBuilder::close(std::uint64_t file_offset) {
  KILN_CHECK(!empty());
  compressed_.resize(ZSTD_compressBound(records_.size()));
  const std::size_t size = ZSTD_compressCCtx(zstd_.get(), compressed_.data(), compressed_.size(),
                                             records_.data(), records_.size(), zstd_level_);
  KILN_CHECK(ZSTD_isError(size) == 0, ZSTD_getErrorName(size));

  Closed closed;
  mcap::append(closed.bytes,
               mcap::Chunk{start_time_, end_time_, records_.size(), mcap::crc32(records_), "zstd",
                           std::string_view(compressed_).substr(0, size)});
  mcap::ChunkIndex& index = closed.index;
  index.start_time = start_time_;
  index.end_time = end_time_;
  index.offset = file_offset;
  index.length = closed.bytes.size();
  index.compression = "zstd";
  index.compressed_size = size;
  index.uncompressed_size = records_.size();
  for (const auto& [channel, entries] : indexes_) {
    index.message_index_offsets[channel] = file_offset + closed.bytes.size();
    closed.message_counts[channel] = entries.entries.size();
    mcap::append(closed.bytes, entries);
  }
  index.message_index_length = closed.bytes.size() - index.length;
  clear();
  return closed;
}

void ChunkBuilder::clear() {
  records_.clear();
  indexes_.clear();
  start_time_ = end_time_ = 0;
}

}  // namespace kiln
