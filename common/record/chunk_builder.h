#pragma once

#include <map>
#include <memory>
#include <string>

#include <zstd.h>

#include "common/record/mcap_format.h"

namespace kiln {

/// Messages on their way into one chunk. Thread-compatible.
class ChunkBuilder {
 public:
  explicit ChunkBuilder(int zstd_level);

  void add(const mcap::Message& message);
  [[nodiscard]] bool empty() const { return indexes_.empty(); }
  [[nodiscard]] std::size_t bytes() const { return records_.size(); }
  [[nodiscard]] std::uint64_t startTime() const { return start_time_; }

  /// The chunk record and its message indexes as bytes, to stand at `file_offset`; the builder is
  /// empty afterwards. @pre not empty.
  struct Closed {
    std::string bytes;
    mcap::ChunkIndex index;
    std::map<std::uint16_t, std::uint64_t> message_counts;  ///< by channel
  };
  [[nodiscard]] Closed close(std::uint64_t file_offset);
  void clear();

 private:
  struct FreeContext {
    void operator()(ZSTD_CCtx* context) const { ZSTD_freeCCtx(context); }
  };
  int zstd_level_;
  std::unique_ptr<ZSTD_CCtx, FreeContext> zstd_;
  std::string records_;
  std::string compressed_;
  std::map<std::uint16_t, mcap::MessageIndex> indexes_;
  std::uint64_t start_time_ = 0, end_time_ = 0;
};

}  // namespace kiln
