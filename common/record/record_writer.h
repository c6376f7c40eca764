#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "common/core/error.h"
#include "common/core/stamp.h"

namespace kiln {

using ChannelId = std::uint16_t;

/// How the messages of a channel are to be read. `data` is a Protobuf FileDescriptorSet for the
/// encoding "protobuf" (record/schema.h makes them).
struct RecordSchema {
  std::string name;
  std::string encoding = "protobuf";
  std::string data;
};

/// Writes one MCAP file: chunked, zstd, indexed, with CRCs (mcap.dev/spec). Schemas, channels and
/// attachments stand in front of the chunks that need them, so that a file that ends anywhere can
/// be read up to its last whole chunk. Thread-compatible.
class RecordWriter {
 public:
  struct Config {
    std::size_t chunk_bytes = 2u << 20;               ///< a chunk is closed at this size
    Duration chunk_period = std::chrono::seconds(1);  ///< or this long after its first message
    int zstd_level = 1;
    std::string library = "kiln";  ///< who wrote it, for the header
  };

  /// Error: Storage when the file exists already or cannot be made.
  [[nodiscard]] static Result<std::unique_ptr<RecordWriter>> create(const std::string& path,
                                                                    Config config);
  [[nodiscard]] static Result<std::unique_ptr<RecordWriter>> create(const std::string& path) {
    return create(path, Config{});
  }
  ~RecordWriter();  ///< closes, if nobody has
  RecordWriter(const RecordWriter&) = delete;
  RecordWriter& operator=(const RecordWriter&) = delete;

  /// A file inside the file: configuration, notes. Error: Storage.
  [[nodiscard]] Result<void> attach(const std::string& name, const std::string& media_type,
                                    std::string_view data, Stamp now);
  /// Messages of one topic. Channels of the same schema name share the schema. Error: Storage;
  /// Refused after close() and beyond 65,535 channels.
  [[nodiscard]] Result<ChannelId> addChannel(const std::string& topic, const RecordSchema& schema);
  /// @param logged     when it was recorded; the order of reading.
  /// @param published  the value's own time.
  /// Error: Storage (disk full: what is in the file stays readable, the chunk in hand is lost);
  /// InvalidInput for an unknown channel or a time before zero; Refused after close().
  [[nodiscard]] Result<void> write(ChannelId channel, Stamp logged, Stamp published,
                                   std::string_view data);
  /// Closes the chunk in hand if its first message is older than the chunk period: to be called now
  /// and then while nothing is written.
  [[nodiscard]] Result<void> flushIfDue(Stamp now);
  /// Closes the chunk in hand and hands it to the system.
  [[nodiscard]] Result<void> flush();
  /// Writes the index. Afterwards everything is Refused.
  [[nodiscard]] Result<void> close();

  [[nodiscard]] std::uint64_t bytesWritten() const;  ///< in the file; the chunk in hand is not
  [[nodiscard]] std::uint64_t messages() const;
  [[nodiscard]] const std::string& path() const;

 private:
  struct Impl;
  explicit RecordWriter(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace kiln
