#include "common/record/record_writer.h"

#include <algorithm>
#include <limits>
#include <map>

#include "common/record/chunk_builder.h"
#include "common/record/mcap_encode.h"
#include "common/record/record_file.h"

namespace kiln {
namespace {

/// Appends the records of one kind and, if there are any, notes where they stand.
template <class Records>
void appendGroup(std::string& summary, std::vector<mcap::SummaryOffset>& groups,
                 mcap::Opcode opcode, std::uint64_t summary_start, const Records& records) {
  const std::size_t before = summary.size();
  for (const auto& record : records) mcap::append(summary, record);
  if (summary.size() != before)
    groups.push_back({opcode, summary_start + before, summary.size() - before});
}

}  // namespace

struct RecordWriter::Impl {
  Impl(std::unique_ptr<RecordFile> f, Config c)
      : file(std::move(f)), config(std::move(c)), chunk(config.zstd_level) {}

  Result<void> put(const std::string& bytes);
  Result<void> checkOpen() const;
  Result<void> closeChunk();
  [[nodiscard]] std::string summary(std::uint64_t start) const;
  [[nodiscard]] mcap::Statistics statistics() const;

  std::unique_ptr<RecordFile> file;
  Config config;
  ChunkBuilder chunk;
  std::uint32_t crc = 0;  ///< of everything in the file
  bool closed = false;
  std::vector<mcap::Schema> schemas;
  std::vector<mcap::Channel> channels;
  std::vector<std::uint32_t> sequences;  ///< by channel
  std::vector<mcap::ChunkIndex> chunks;
  std::vector<mcap::AttachmentIndex> attachments;
  std::map<std::uint16_t, std::uint64_t> message_counts;
};

Result<void> RecordWriter::Impl::put(const std::string& bytes) {
  if (auto written = file->append(bytes); !written) return written;
  crc = mcap::crc32(bytes, crc);
  return {};
}

Result<void> RecordWriter::Impl::checkOpen() const {
  if (!closed) return {};
  return makeError(ErrorCode::Refused, "{}: the recording is closed already", file->path());
}

Result<void> RecordWriter::Impl::closeChunk() {
  if (chunk.empty()) return {};
  auto done = chunk.close(file->size());
  if (auto written = put(done.bytes); !written) return written;
  chunks.push_back(std::move(done.index));
  for (const auto& [channel, count] : done.message_counts) message_counts[channel] += count;
  return {};
}

mcap::Statistics RecordWriter::Impl::statistics() const {
  mcap::Statistics s;
  for (const auto& [channel, count] : message_counts) s.message_count += count;
  s.schema_count = static_cast<std::uint16_t>(schemas.size());
  s.channel_count = static_cast<std::uint32_t>(channels.size());
  s.attachment_count = static_cast<std::uint32_t>(attachments.size());
  s.chunk_count = static_cast<std::uint32_t>(chunks.size());
  s.start_time = chunks.empty() ? 0 : std::numeric_limits<std::uint64_t>::max();
  for (const mcap::ChunkIndex& index : chunks) {
    s.start_time = std::min(s.start_time, index.start_time);
    s.end_time = std::max(s.end_time, index.end_time);
  }
  s.channel_message_counts = message_counts;
  return s;
}

std::string RecordWriter::Impl::summary(std::uint64_t start) const {
  std::string out;
  std::vector<mcap::SummaryOffset> groups;
  appendGroup(out, groups, mcap::Opcode::Schema, start, schemas);
  appendGroup(out, groups, mcap::Opcode::Channel, start, channels);
  appendGroup(out, groups, mcap::Opcode::Statistics, start, std::vector{statistics()});
  appendGroup(out, groups, mcap::Opcode::ChunkIndex, start, chunks);
  appendGroup(out, groups, mcap::Opcode::AttachmentIndex, start, attachments);
  const std::uint64_t offsets_start = start + out.size();
  for (const mcap::SummaryOffset& group : groups) mcap::append(out, group);
  mcap::appendFooter(out, {start, offsets_start, 0}, std::string(out));
  out.append(mcap::kMagic);
  return out;
}

Result<std::unique_ptr<RecordWriter>> RecordWriter::create(const std::string& path, Config config) {
  auto file = RecordFile::create(path);
  if (!file) return tl::make_unexpected(file.error());
  auto impl = std::make_unique<Impl>(std::move(*file), std::move(config));
  std::string head(mcap::kMagic);
  mcap::append(head, mcap::Header{"", impl->config.library});
  if (auto written = impl->put(head); !written) return tl::make_unexpected(written.error());
  return std::unique_ptr<RecordWriter>(new RecordWriter(std::move(impl)));
}

RecordWriter::RecordWriter(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
RecordWriter::~RecordWriter() {
  if (!impl_->closed) (void)close();  // nobody is left to hear of a failure; a reader copes with it
}

Result<void> RecordWriter::attach(const std::string& name, const std::string& media_type,
                                  std::string_view data, Stamp now) {
  if (auto open = impl_->checkOpen(); !open) return open;
  const auto time = static_cast<std::uint64_t>(std::max<std::int64_t>(0, toNanoseconds(now)));
  std::string bytes;
  mcap::append(bytes, mcap::Attachment{time, time, name, media_type, data});
  const std::uint64_t offset = impl_->file->size();
  if (auto written = impl_->put(bytes); !written) return written;
  impl_->attachments.push_back({offset, bytes.size(), time, time, data.size(), name, media_type});
  return {};
}

Result<ChannelId> RecordWriter::addChannel(const std::string& topic, const RecordSchema& schema) {
  if (auto open = impl_->checkOpen(); !open) return tl::make_unexpected(open.error());
  if (impl_->channels.size() >= std::numeric_limits<ChannelId>::max()) {
    return makeError(ErrorCode::Refused, "{}: no more than 65,535 channels fit into a recording",
                     path());
  }
  std::string bytes;
  const auto known = std::find_if(impl_->schemas.begin(), impl_->schemas.end(),
                                  [&](const mcap::Schema& s) { return s.name == schema.name; });
  mcap::Schema added;
  if (known == impl_->schemas.end()) {
    added = {static_cast<std::uint16_t>(impl_->schemas.size() + 1), schema.name, schema.encoding,
             schema.data};
    mcap::append(bytes, added);
  }
  mcap::Channel channel;
  channel.id = static_cast<ChannelId>(impl_->channels.size() + 1);
  channel.schema_id = added.id != 0 ? added.id : known->id;
  channel.topic = topic;
  channel.message_encoding = schema.encoding;
  mcap::append(bytes, channel);
  if (auto written = impl_->put(bytes); !written) return tl::make_unexpected(written.error());
  if (added.id != 0) impl_->schemas.push_back(std::move(added));
  impl_->channels.push_back(channel);
  impl_->sequences.push_back(0);
  return channel.id;
}

Result<void> RecordWriter::write(ChannelId channel, Stamp logged, Stamp published,
                                 std::string_view data) {
  if (auto open = impl_->checkOpen(); !open) return open;
  if (channel == 0 || channel > impl_->channels.size()) {
    return makeError(ErrorCode::InvalidInput, "{}: there is no channel {}; add it first", path(),
                     channel);
  }
  if (toNanoseconds(logged) < 0 || toNanoseconds(published) < 0) {
    return makeError(ErrorCode::InvalidInput, "{}: a message on {} has a time before zero", path(),
                     impl_->channels[channel - 1u].topic);
  }
  if (auto flushed = flushIfDue(logged); !flushed) return flushed;
  impl_->chunk.add({channel, ++impl_->sequences[channel - 1u],
                    static_cast<std::uint64_t>(toNanoseconds(logged)),
                    static_cast<std::uint64_t>(toNanoseconds(published)), data});
  return impl_->chunk.bytes() >= impl_->config.chunk_bytes ? flush() : Result<void>{};
}

Result<void> RecordWriter::flushIfDue(Stamp now) {
  const ChunkBuilder& chunk = impl_->chunk;
  const auto period = static_cast<std::uint64_t>(impl_->config.chunk_period.count());
  const auto time = static_cast<std::uint64_t>(std::max<std::int64_t>(0, toNanoseconds(now)));
  if (chunk.empty() || time < chunk.startTime() + period) return {};
  return flush();
}

Result<void> RecordWriter::flush() {
  if (auto open = impl_->checkOpen(); !open) return open;
  return impl_->closeChunk();
}

Result<void> RecordWriter::close() {
  if (auto open = impl_->checkOpen(); !open) return open;
  auto flushed = impl_->closeChunk();
  impl_->closed = true;
  if (!flushed) return flushed;
  std::string end;
  mcap::appendDataEnd(end, impl_->crc);
  return impl_->file->append(end + impl_->summary(impl_->file->size() + end.size()));
}

std::uint64_t RecordWriter::bytesWritten() const { return impl_->file->size(); }
std::uint64_t RecordWriter::messages() const {
  std::uint64_t sum = 0;
  for (const std::uint32_t n : impl_->sequences) sum += n;
  return sum;
}
const std::string& RecordWriter::path() const { return impl_->file->path(); }

}  // namespace kiln
