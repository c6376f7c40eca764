#include "common/record/record_scan.h"

#include <algorithm>
#include <limits>

#include "common/record/mcap_decode.h"

namespace kiln {
namespace {

constexpr std::uint64_t kMaxIndexRecord = 32u << 20;
constexpr std::uint64_t kChunkHead = 64;  // enough for a chunk's fields up to its records
constexpr std::uint64_t kMessageHead = 22;
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
      if (head->opcode != mcap::Opcode::Message) finishLoose();
      if (!take(*head, at)) break;
      at += mcap::kRecordHeadBytes + head->length;
    }
    finishLoose();
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
        const auto bytes = content(head, at, kMaxDescriptionBytes);
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
      case mcap::Opcode::Message:
        return takeMessage(head, at);
      default:
        return true;  // header, metadata, what later versions may add
    }
  }

  /// The first description of a channel or schema counts.
  bool describe(const mcap::Record& record) {
    if (described_bytes_ + record.content.size() > kMaxDescriptionBytes) return true;
    if (record.opcode == mcap::Opcode::Schema) {
      auto schema = mcap::decodeSchema(record.content);
      if (schema && index_.schemas.try_emplace(schema->id, *schema).second)
        described_bytes_ += record.content.size();
      return schema.has_value();
    }
    auto channel = mcap::decodeChannel(record.content);
    if (channel && index_.channels.try_emplace(channel->id, *channel).second)
      described_bytes_ += record.content.size();
    return channel.has_value();
  }

  bool beginChunk(const Head& head, std::uint64_t at) {
    const auto bytes =
        file_.read(at + mcap::kRecordHeadBytes, std::min<std::uint64_t>(head.length, kChunkHead));
    if (!bytes) return false;
    mcap::ByteReader in(*bytes);
    ChunkEntry entry{at, mcap::kRecordHeadBytes + head.length, in.u64(), in.u64(), {}, {}};
    (void)in.u64();
    (void)in.u32();
    entry.compression = in.text();
    if (!in.ok()) entry.compression.clear();  // reading it will say what is wrong
    if (entry.start_time > entry.end_time || entry.end_time > kLatestTime)
      entry.start_time = entry.end_time = latest_;
    latest_ = entry.end_time;
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
    // One that cannot be read stays, with its channels unknown: the cursor names it.
    if (!known && !lookInto(*open_)) {
      open_->channels.clear();
      pending_counts_.clear();
    }
    for (const auto& [channel, count] : pending_counts_) {
      index_.message_counts[channel] += count;
      open_->messages += count;
    }
    index_.chunks.push_back(std::move(*open_));
    open_.reset();
    pending_counts_.clear();
  }

  bool takeMessage(const Head& head, std::uint64_t at) {
    const auto bytes = file_.read(at + mcap::kRecordHeadBytes, std::min(head.length, kMessageHead));
    const auto message = bytes ? mcap::decodeMessage(*bytes) : std::nullopt;
    if (!message || message->log_time > kLatestTime) return true;  // costs itself alone
    const std::uint64_t size = mcap::kRecordHeadBytes + head.length;
    if (loose_.messages > 0 && loose_.length + size > kMaxLooseBytes) finishLoose();
    if (loose_.messages == 0) {
      loose_ = ChunkEntry{at, 0, message->log_time, message->log_time, {}, {}};
      loose_.loose = true;
    }
    loose_.length = at + size - loose_.offset;
    loose_.start_time = std::min(loose_.start_time, message->log_time);
    loose_.end_time = std::max(loose_.end_time, message->log_time);
    ++loose_.messages;
    ++index_.message_counts[message->channel_id];
    return true;
  }

  void finishLoose() {
    if (loose_.messages > 0) index_.chunks.push_back(std::move(loose_));
    loose_ = {};
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
  ChunkEntry loose_;          ///< the run of messages outside of chunks, if it has any
  std::uint64_t latest_ = 0;  ///< end of the last chunk with times that make sense
  std::size_t described_bytes_ = 0;
  std::map<std::uint16_t, std::uint64_t> pending_counts_;
};

}  // namespace

RecordIndex scanRecords(const RandomFile& file) { return Scan(file).run(); }

}  // namespace kiln
