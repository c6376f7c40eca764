#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "common/core/error.h"
#include "common/record/mcap_format.h"

namespace kiln {

/// A file read by offset. Thread-safe.
class RandomFile {
 public:
  [[nodiscard]] static Result<std::shared_ptr<const RandomFile>> open(const std::string& path);
  ~RandomFile();
  RandomFile(const RandomFile&) = delete;
  RandomFile& operator=(const RandomFile&) = delete;

  /// Exactly `size` bytes. Error: Truncated where the file ends before; Storage.
  [[nodiscard]] Result<std::string> read(std::uint64_t offset, std::uint64_t size) const;
  [[nodiscard]] std::uint64_t size() const { return size_; }
  [[nodiscard]] const std::string& path() const { return path_; }

 private:
  RandomFile(int fd, std::string path, std::uint64_t size);
  const int fd_;
  const std::string path_;
  const std::uint64_t size_;
};

/// One chunk of a recording, or a run of messages that stand outside of chunks.
struct ChunkEntry {
  std::uint64_t offset = 0, length = 0;  ///< of the record in the file, with its head
  std::uint64_t start_time = 0, end_time = 0;
  std::vector<std::uint16_t> channels;  ///< sorted; empty: not known, may hold any
  std::string compression;              ///< as the file names it; empty: none
  std::uint64_t messages = 0;           ///< 0: not known
  bool loose = false;                   ///< messages outside of chunks
  std::uint64_t index_length = 0;       ///< of the message indexes behind it, if a summary says so
};

/// What is where in a recording.
struct RecordIndex {
  bool complete = false;         ///< ends as it should; else it was cut off or is being written
  std::uint64_t lost_bytes = 0;  ///< behind the last whole record of a file that was cut off
  std::string library;
  std::map<std::uint16_t, mcap::Schema> schemas;
  std::map<std::uint16_t, mcap::Channel> channels;
  std::map<std::uint16_t, std::uint64_t> message_counts;  ///< by channel; may be empty
  std::vector<ChunkEntry> chunks;                         ///< by start time, then offset
  std::vector<mcap::AttachmentIndex> attachments;
  std::uint64_t start_time = 0, end_time = 0;  ///< the time line, see findTimeLine()
  std::uint64_t outliers = 0;                  ///< messages that lie outside of it
};

inline constexpr std::uint64_t kMaxChunkBytes = 32u << 20;        ///< unpacked
inline constexpr std::uint64_t kMaxLooseBytes = 2u << 20;         ///< of a run outside of chunks
inline constexpr std::uint64_t kMaxDescriptionBytes = 16u << 20;  ///< schemas and channels in all

/// Reads the summary, or scans the data section when there is none, it is damaged, or it leaves out
/// a channel, a schema or messages. Error: InvalidInput when this is no MCAP file or all of it is
/// compressed in a way that Kiln cannot read.
[[nodiscard]] Result<RecordIndex> readIndex(const RandomFile& file);

/// A chunk's records, decompressed, its CRC checked. At most kMaxChunkBytes.
[[nodiscard]] Result<std::string> readChunk(const RandomFile& file, const ChunkEntry& chunk);

}  // namespace kiln
