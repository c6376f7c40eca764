#include "common/record/record_scan.h"

#include <algorithm>
#include <limits>

#include "common/record/mcap_decode.h"

namespace kiln {
namespace {

constexpr std::uint64_t kMaxDescription = 16u << 20;  // a schema or channel record
constexpr std::uint64_t kMaxIndexRecord = 64u << 20;
constexpr std::uint64_t kChunkHead = 64;  // enough for a chunk's fields up to its records
constexpr std::uint64_t kAttachmentHead = 4096;
constexpr std::uint64_t kLatestTime = std::numeric_limits<std::int64_t>::max();

class Scan {
 public:
  explicit Scan(const RandomFile& file) : file_(file) {}

  RecordIndex run() {
    std::uint64_t at = mcap::kMagic.size();
    while (const auto head = headAt(at)) {
      if (head->opcode == mcap::Opcode::DataEnd) {
        index_.complete = true;
        break;
      }
      if (!take(*head, at)) break;
      at += mcap::kRecordHeadBytes + head->length;
    }
    finishChunk(!index_.complete);
    if (!index_.complete) index_.lost_bytes = file_.size() - std::min(at, file_.size());
    return std::move(index_);
  }

 private:
  struct Head {
    mcap::Opcode opcode;
    std::uint64_t length;
  };

  /// nullopt where the file ends or the record is not whole.
  std::optional<Head> headAt(std::uint64_t at) const {
    const auto bytes = file_.read(at, mcap::kRecordHeadBytes);
    if (!bytes) return std::nullopt;
    mcap::ByteReader in(*bytes);
    const Head head{static_cast<mcap::Opcode>(in.u8()), in.u64()};
    const std::uint64_t rest = file_.size() - at - mcap::kRecordHeadBytes;
    if (head.opcode == mcap::Opcode{0} || head.length > rest) return std::nullopt;
    return head;
  }

  std::optional<std::string> content(const Head& head, std::uint64_t at,
                                     std::uint64_t limit) const {
    if (head.length > limit) return std::nullopt;
    auto bytes = file_.read(at + mcap::kRecordHeadBytes, head.length);
    if (!bytes) return std::nullopt;
    return std::move(*bytes);
  }

  /// @return false when the record is not what it says: the scan ends in front of it.
  bool take(const Head& head, std::uint64_t at) {
    switch (head.opcode) {
      case mcap::Opcode::Schema:
      case mcap::Opcode::Channel: {
        const auto bytes = content(head, at, kMaxDescription);
        return bytes && describe({head.opcode, *bytes});
      }
      case mcap::Opcode::Chunk:
        finishChunk(false);
        return beginChunk(head, at);
      case mcap::Opcode::MessageIndex: {
        const auto bytes = content(head, at, kMaxIndexRecord);
        return bytes && takeMessageIndex(*bytes);
      }
      case mcap::Opcode::Attachment:
        return takeAttachment(head, at);
      default:
        return true;  // header, metadata, loose messages, what later versions may add
    }
  }

  bool describe(const mcap::Record& record) {
    if (record.opcode == mcap::Opcode::Schema) {
      auto schema = mcap::decodeSchema(record.content);
      if (schema) index_.schemas[schema->id] = std::move(*schema);
      return schema.has_value();
    }
    auto channel = mcap::decodeChannel(record.content);
    if (channel) index_.channels[channel->id] = std::move(*channel);
    return channel.has_value();
  }

  bool beginChunk(const Head& head, std::uint64_t at) {
    const auto bytes =
        file_.read(at + mcap::kRecordHeadBytes, std::min<std::uint64_t>(head.length, kChunkHead));
    if (!bytes) return false;
    mcap::ByteReader in(*bytes);
    ChunkEntry entry{at, mcap::kRecordHeadBytes + head.length, in.u64(), in.u64(), {}};
    if (!in.ok() || entry.start_time > entry.end_time || entry.end_time > kLatestTime) return false;
    open_ = std::move(entry);
    return true;
  }

  bool takeMessageIndex(std::string_view bytes) {
    const auto entries = mcap::decodeMessageIndex(bytes);
    if (!entries || !open_) return entries.has_value();
    open_->channels.push_back(entries->channel_id);
    pending_counts_[entries->channel_id] += entries->entries.size();
    return true;
  }

  /// The last chunk's message indexes have been seen, or were cut off. Channels that nobody has
  /// described yet stand in the chunk itself (other writers do that).
  void finishChunk(bool cut_off) {
    if (!open_) return;
    std::sort(open_->channels.begin(), open_->channels.end());
    const bool known = !cut_off && !open_->channels.empty() &&
                       std::all_of(open_->channels.begin(), open_->channels.end(),
                                   [&](auto id) { return index_.channels.contains(id); });
    if (known || lookInto(*open_)) {
      for (const auto& [channel, count] : pending_counts_) index_.message_counts[channel] += count;
      index_.chunks.push_back(std::move(*open_));
    }
    open_.reset();
    pending_counts_.clear();
  }

  bool lookInto(ChunkEntry& entry) {
    const auto records = readChunk(file_, entry);
    if (!records) return false;
    entry.channels.clear();
    pending_counts_.clear();
    mcap::ByteReader in(*records);
    while (const auto record = mcap::nextRecord(in)) {
      if (record->opcode == mcap::Opcode::Schema || record->opcode == mcap::Opcode::Channel) {
        (void)describe(*record);
      } else if (record->opcode == mcap::Opcode::Message) {
        if (const auto message = mcap::decodeMessage(record->content))
          ++pending_counts_[message->channel_id];
      }
    }
    for (const auto& [channel, count] : pending_counts_) entry.channels.push_back(channel);
    return true;
  }

  bool takeAttachment(const Head& head, std::uint64_t at) {
    const auto bytes = file_.read(at + mcap::kRecordHeadBytes,
                                  std::min<std::uint64_t>(head.length, kAttachmentHead));
    if (!bytes) return false;
    mcap::ByteReader in(*bytes);
    mcap::AttachmentIndex entry;
    entry.offset = at;
    entry.length = mcap::kRecordHeadBytes + head.length;
    entry.log_time = in.u64();
    entry.create_time = in.u64();
    entry.name = in.text();
    entry.media_type = in.text();
    entry.data_size = in.u64();
    if (in.ok()) index_.attachments.push_back(std::move(entry));
    return true;
  }

  const RandomFile& file_;
  RecordIndex index_;
  std::optional<ChunkEntry> open_;
  std::map<std::uint16_t, std::uint64_t> pending_counts_;
};

}  // namespace

RecordIndex scanRecords(const RandomFile& file) { return Scan(file).run(); }

}  // namespace kiln
