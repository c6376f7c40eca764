#include "common/record/record_cursor.h"

#include <algorithm>
#include <limits>

#include "common/record/mcap_decode.h"
#include "common/record/record_content.h"

namespace kiln {
namespace {

constexpr std::size_t kMaxLoadedBytes = 48u << 20;  // a recorder's chunks overlap by one or two
constexpr std::uint64_t kLatestTime = std::numeric_limits<std::int64_t>::max();

Stamp stampOf(std::uint64_t time) {
  return stampFromNanoseconds(static_cast<std::int64_t>(std::min(time, kLatestTime)));
}

std::uint64_t timeOf(Stamp stamp) {
  return static_cast<std::uint64_t>(std::max<std::int64_t>(0, toNanoseconds(stamp)));
}

}  // namespace

RecordCursor::RecordCursor(std::shared_ptr<const RecordContent> content,
                           std::vector<std::uint16_t> channels, Stamp from)
    : content_(std::move(content)), channels_(std::move(channels)) {
  std::sort(channels_.begin(), channels_.end());
  const auto& chunks = content_->index.chunks;
  std::uint64_t latest = 0;
  for (std::size_t i = 0; i < chunks.size(); ++i) {
    const auto& has = chunks[i].channels;
    if (!has.empty() && std::none_of(has.begin(), has.end(), [&](auto c) { return wanted(c); }))
      continue;
    latest = std::max(latest, chunks[i].end_time);
    order_.push_back(i);
    ends_.push_back(latest);
  }
  seek(from);
}

bool RecordCursor::wanted(std::uint16_t channel) const {
  return std::binary_search(channels_.begin(), channels_.end(), channel);
}

void RecordCursor::seek(Stamp t) {
  from_ = std::max(timeOf(t), content_->index.start_time);
  loaded_.clear();
  next_chunk_ =
      static_cast<std::size_t>(std::lower_bound(ends_.begin(), ends_.end(), from_) - ends_.begin());
}

Result<void> RecordCursor::load(std::size_t order) {
  const ChunkEntry& chunk = content_->index.chunks[order_[order]];
  if (chunk.end_time < from_)
    return {};  // before the place that was sought, in spite of an overlap
  auto records = readChunk(*content_->file, chunk);
  if (!records) return tl::make_unexpected(records.error());
  std::size_t held = records->size();
  for (const Loaded& other : loaded_)
    held += other.records->size() + other.entries.size() * sizeof(Entry);
  if (!loaded_.empty() && held > kMaxLoadedBytes) {
    return makeError(ErrorCode::InvalidInput,
                     "{}: chunks of more than {} MiB overlap in time at {}; one is left out",
                     content_->file->path(), kMaxLoadedBytes >> 20, chunk.offset);
  }
  Loaded loaded;
  loaded.order = order;
  loaded.records = std::make_shared<const std::string>(std::move(*records));
  mcap::ByteReader in(*loaded.records);
  while (const auto record = mcap::nextRecord(in)) {
    if (record->opcode != mcap::Opcode::Message) continue;
    const auto m = mcap::decodeMessage(record->content);
    if (!m || m->log_time < from_ || m->log_time > content_->index.end_time) continue;
    if (!wanted(m->channel_id)) continue;
    loaded.entries.push_back({m->log_time, m->publish_time, m->sequence, m->channel_id, m->data});
  }
  std::stable_sort(loaded.entries.begin(), loaded.entries.end(),
                   [](const Entry& a, const Entry& b) { return a.log_time < b.log_time; });
  if (!loaded.entries.empty()) loaded_.push_back(std::move(loaded));
  return {};
}

Result<std::optional<std::size_t>> RecordCursor::earliest() {
  for (;;) {
    std::optional<std::size_t> best;
    for (std::size_t i = 0; i < loaded_.size(); ++i) {
      const auto key = [&](std::size_t k) {
        return std::pair(loaded_[k].entries[loaded_[k].next].log_time, loaded_[k].order);
      };
      if (!best || key(i) < key(*best)) best = i;
    }
    const bool more = next_chunk_ < order_.size();
    if (!more) return best;
    const std::uint64_t next_start = content_->index.chunks[order_[next_chunk_]].start_time;
    if (best && loaded_[*best].entries[loaded_[*best].next].log_time < next_start) return best;
    if (auto done = load(next_chunk_++); !done) return tl::make_unexpected(done.error());
  }
}

Result<std::optional<RecordedMessage>> RecordCursor::next() {
  const auto at = earliest();
  if (!at) return tl::make_unexpected(at.error());
  if (!*at) return std::nullopt;
  Loaded& chunk = loaded_[**at];
  const Entry& entry = chunk.entries[chunk.next++];
  RecordedMessage message{entry.channel,
                          content_->topicOf(entry.channel),
                          content_->schemaOf(entry.channel),
                          entry.sequence,
                          stampOf(entry.log_time),
                          stampOf(entry.publish_time),
                          entry.data,
                          chunk.records};
  if (chunk.next == chunk.entries.size()) {
    loaded_.erase(loaded_.begin() + static_cast<std::ptrdiff_t>(**at));
  }
  return message;
}

Result<std::optional<Stamp>> RecordCursor::peek() {
  const auto at = earliest();
  if (!at) return tl::make_unexpected(at.error());
  if (!*at) return std::nullopt;
  const Loaded& chunk = loaded_[**at];
  return stampOf(chunk.entries[chunk.next].log_time);
}

}  // namespace kiln
