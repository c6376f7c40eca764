#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/core/error.h"
#include "common/core/stamp.h"
#include "common/record/record_cursor.h"

namespace kiln {

/// What a recording holds of one topic.
struct RecordedTopic {
  std::uint16_t channel = 0;
  std::string topic;
  std::string schema;                     ///< "foxglove.PointCloud"
  std::string message_encoding;           ///< "protobuf"
  std::optional<std::uint64_t> messages;  ///< nullopt: not counted
};

/// An MCAP file. Opening reads the index (a file that was cut off is scanned, 9 bytes a record);
/// messages are read chunk by chunk, so that memory stays bounded by a few chunks. Copies share the
/// file. Thread-safe: each cursor belongs to one thread.
class RecordReader {
 public:
  /// Error: NotFound, Storage; InvalidInput when the file is no MCAP recording.
  [[nodiscard]] static Result<RecordReader> open(const std::string& path);

  [[nodiscard]] const std::string& path() const;
  /// False: cut off by a crash or still being written; what is whole can be read.
  [[nodiscard]] bool complete() const;
  [[nodiscard]] std::uint64_t lostBytes() const;  ///< behind the last whole record
  /// What is wrong with the file as a whole, for the log and the window; empty: nothing.
  [[nodiscard]] std::string defects() const;
  [[nodiscard]] bool empty() const;   ///< no messages at all
  [[nodiscard]] Stamp start() const;  ///< log time of the first message; 0 if empty
  [[nodiscard]] Stamp end() const;    ///< of the last one
  [[nodiscard]] std::vector<RecordedTopic> topics() const;
  [[nodiscard]] std::vector<std::string> attachments() const;
  /// The schema's bytes (FileDescriptorSet). Error: NotFound.
  [[nodiscard]] Result<std::string> schema(const std::string& name) const;
  /// Content of the newest attachment of this name. Error: NotFound; InvalidInput when damaged.
  [[nodiscard]] Result<std::string> attachment(const std::string& name) const;

  /// Messages of `topics` (empty: all) in the order of their log time, from `from` on.
  [[nodiscard]] RecordCursor messages(const std::vector<std::string>& topics = {},
                                      Stamp from = Stamp{}) const;
  /// The last message of each of `topics` (empty: all) at or before `t`, by log time: what a viewer
  /// that jumps to `t` must show. A topic without one is left out, as is what cannot be read.
  [[nodiscard]] std::vector<RecordedMessage> newestBefore(
      Stamp t, const std::vector<std::string>& topics = {}) const;

 private:
  explicit RecordReader(std::shared_ptr<const RecordContent> content)
      : content_(std::move(content)) {}
  [[nodiscard]] std::vector<std::uint16_t> channelsOf(const std::vector<std::string>& topics) const;
  std::shared_ptr<const RecordContent> content_;
};

}  // namespace kiln
