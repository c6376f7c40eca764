#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/core/error.h"
#include "common/core/stamp.h"

namespace kiln {

struct RecordContent;  ///< file and index, shared; private to the reader

/// One message as it stands in a recording.
struct RecordedMessage {
  std::uint16_t channel = 0;
  std::string_view topic;  ///< lives as long as the reader or any of its cursors
  std::string_view schema;
  std::uint32_t sequence = 0;
  Stamp logged;
  Stamp published;
  std::string_view data;
  std::shared_ptr<const std::string> storage;  ///< keeps `data` alive
};

/// Walks over a recording by log time. Chunks that overlap in time are merged; those without a
/// wanted channel are skipped unread. Thread-compatible.
class RecordCursor {
 public:
  RecordCursor(std::shared_ptr<const RecordContent> content, std::vector<std::uint16_t> channels,
               Stamp from);

  /// nullopt at the end. Error: a chunk is damaged and has been left out; the next call goes on
  /// behind it.
  [[nodiscard]] Result<std::optional<RecordedMessage>> next();
  /// Log time of what next() would return, without taking it; nullopt at the end.
  [[nodiscard]] Result<std::optional<Stamp>> peek();
  /// Goes to the first message at or after `t`: a binary search over the chunks.
  void seek(Stamp t);

 private:
  struct Entry {
    std::uint64_t log_time;
    std::uint64_t publish_time;
    std::uint32_t sequence;
    std::uint16_t channel;
    std::string_view data;
  };
  struct Loaded {
    std::size_t order = 0;  ///< of the chunk, for ties
    std::shared_ptr<const std::string> records;
    std::vector<Entry> entries;  ///< by log time
    std::size_t next = 0;
  };
  [[nodiscard]] bool wanted(std::uint16_t channel) const;
  /// Index into loaded_ of the chunk with the earliest message, after loading what may hold an
  /// earlier one; nullopt at the end.
  [[nodiscard]] Result<std::optional<std::size_t>> earliest();
  [[nodiscard]] Result<void> load(std::size_t order);

  std::shared_ptr<const RecordContent> content_;
  std::vector<std::uint16_t> channels_;  ///< sorted
  std::vector<std::size_t> order_;       ///< chunks with a wanted channel, by start time
  std::vector<std::uint64_t> ends_;      ///< latest end time of order_[0..i]
  std::size_t next_chunk_ = 0;           ///< into order_
  std::uint64_t from_ = 0;
  std::vector<Loaded> loaded_;
};

}  // namespace kiln
