#include "common/record/record_reader.h"

#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "common/record/mcap_decode.h"
#include "common/record/record_content.h"

namespace kiln {

Result<RecordReader> RecordReader::open(const std::string& path) {
  auto file = RandomFile::open(path);
  if (!file) return tl::make_unexpected(file.error());
  auto index = readIndex(**file);
  if (!index) return tl::make_unexpected(index.error());
  auto content = std::make_shared<RecordContent>();
  content->file = std::move(*file);
  content->index = std::move(*index);
  return RecordReader(std::move(content));
}

const std::string& RecordReader::path() const { return content_->file->path(); }
bool RecordReader::complete() const { return content_->index.complete; }
std::uint64_t RecordReader::lostBytes() const { return content_->index.lost_bytes; }
std::string RecordReader::defects() const {
  std::string out;
  if (!complete()) {
    out = fmt::format("the recording was cut off; {} bytes at its end are lost", lostBytes());
  }
  if (const auto outliers = content_->index.outliers; outliers > 0) {
    out += fmt::format("{}{} messages have a time far from all others and are left out",
                       out.empty() ? "" : "; ", outliers);
  }
  return out;
}
bool RecordReader::empty() const { return content_->index.chunks.empty(); }

Stamp RecordReader::start() const {
  return stampFromNanoseconds(static_cast<std::int64_t>(content_->index.start_time));
}

Stamp RecordReader::end() const {
  return stampFromNanoseconds(static_cast<std::int64_t>(content_->index.end_time));
}

std::vector<RecordedTopic> RecordReader::topics() const {
  std::vector<RecordedTopic> out;
  const RecordIndex& index = content_->index;
  for (const auto& [id, channel] : index.channels) {
    RecordedTopic topic{id, channel.topic, std::string(content_->schemaOf(id)),
                        channel.message_encoding, std::nullopt};
    if (const auto count = index.message_counts.find(id); count != index.message_counts.end())
      topic.messages = count->second;
    out.push_back(std::move(topic));
  }
  return out;
}

std::vector<std::string> RecordReader::attachments() const {
  std::vector<std::string> out;
  for (const auto& entry : content_->index.attachments) out.push_back(entry.name);
  return out;
}

Result<std::string> RecordReader::schema(const std::string& name) const {
  for (const auto& [id, schema] : content_->index.schemas) {
    if (schema.name == name) return schema.data;
  }
  return makeError(ErrorCode::NotFound, "{}: there is no schema '{}' in it", path(), name);
}

Result<std::string> RecordReader::attachment(const std::string& name) const {
  const auto& all = content_->index.attachments;
  const auto found =
      std::find_if(all.rbegin(), all.rend(), [&](const auto& entry) { return entry.name == name; });
  if (found == all.rend())
    return makeError(ErrorCode::NotFound, "{}: there is no attachment '{}' in it", path(), name);
  const auto bytes = content_->file->read(found->offset, found->length);
  if (!bytes) return bytes;
  mcap::ByteReader in(*bytes);
  const auto record = mcap::nextRecord(in);
  const auto content = record && record->opcode == mcap::Opcode::Attachment
                           ? mcap::decodeAttachment(record->content)
                           : std::nullopt;
  if (!content)
    return makeError(ErrorCode::InvalidInput, "{}: the attachment '{}' is damaged", path(), name);
  return std::string(content->data);
}

std::vector<std::uint16_t> RecordReader::channelsOf(const std::vector<std::string>& topics) const {
  std::vector<std::uint16_t> out;
  for (const auto& [id, channel] : content_->index.channels) {
    if (topics.empty() || std::find(topics.begin(), topics.end(), channel.topic) != topics.end())
      out.push_back(id);
  }
  return out;
}

RecordCursor RecordReader::messages(const std::vector<std::string>& topics, Stamp from) const {
  return RecordCursor(content_, channelsOf(topics), from);
}

std::vector<RecordedMessage> RecordReader::newestBefore(
    Stamp t, const std::vector<std::string>& topics) const {
  const auto time = static_cast<std::uint64_t>(std::max<std::int64_t>(0, toNanoseconds(t)));
  const auto channels = channelsOf(topics);
  std::set<std::uint16_t> missing(channels.begin(), channels.end());
  std::vector<RecordedMessage> found;
  const auto& chunks = content_->index.chunks;
  auto chunk =
      std::upper_bound(chunks.begin(), chunks.end(), time,
                       [](std::uint64_t a, const ChunkEntry& c) { return a < c.start_time; });
  while (chunk != chunks.begin() && !missing.empty()) {
    --chunk;
    const bool helps =
        chunk->channels.empty() || std::any_of(chunk->channels.begin(), chunk->channels.end(),
                                               [&](auto id) { return missing.contains(id); });
    if (!helps) continue;
    auto records = readChunk(*content_->file, *chunk);
    if (!records) continue;
    const auto storage = std::make_shared<const std::string>(std::move(*records));
    std::map<std::uint16_t, mcap::Message> newest;
    mcap::ByteReader in(*storage);
    while (const auto record = mcap::nextRecord(in)) {
      if (record->opcode != mcap::Opcode::Message) continue;
      const auto m = mcap::decodeMessage(record->content);
      if (!m || m->log_time > time || !missing.contains(m->channel_id)) continue;
      if (m->log_time < content_->index.start_time || m->log_time > content_->index.end_time)
        continue;
      const auto [known, inserted] = newest.try_emplace(m->channel_id, *m);
      if (!inserted && known->second.log_time <= m->log_time) known->second = *m;
    }
    for (const auto& [id, m] : newest) {
      missing.erase(id);
      const auto bytes = std::make_shared<const std::string>(m.data);  // not the whole chunk
      found.push_back({id, content_->topicOf(id), content_->schemaOf(id), m.sequence,
                       stampFromNanoseconds(static_cast<std::int64_t>(m.log_time)),
                       stampFromNanoseconds(static_cast<std::int64_t>(m.publish_time)), *bytes,
                       bytes});
    }
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const auto& a, const auto& b) { return a.logged < b.logged; });
  return found;
}

}  // namespace kiln
