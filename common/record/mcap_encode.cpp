#include "common/record/mcap_encode.h"

#include <zlib.h>

namespace kiln::mcap {
namespace {

template <class Int>
void put(std::string& out, Int value) {
  for (std::size_t i = 0; i < sizeof(Int); ++i) {
    out.push_back(static_cast<char>((static_cast<std::uint64_t>(value) >> (8 * i)) & 0xFFu));
  }
}

void putText(std::string& out, std::string_view text) {
  put(out, static_cast<std::uint32_t>(text.size()));
  out.append(text);
}

/// Writes opcode and a length that is filled in when the record is complete.
class RecordScope {
 public:
  RecordScope(std::string& out, Opcode opcode) : out_(out) {
    put(out_, static_cast<std::uint8_t>(opcode));
    start_ = out_.size();
    put(out_, std::uint64_t{0});
  }
  ~RecordScope() {
    const std::uint64_t length = out_.size() - start_ - 8;
    for (std::size_t i = 0; i < 8; ++i)
      out_[start_ + i] = static_cast<char>((length >> (8 * i)) & 0xFFu);
  }
  RecordScope(const RecordScope&) = delete;
  RecordScope& operator=(const RecordScope&) = delete;

 private:
  std::string& out_;
  std::size_t start_ = 0;
};

/// Maps and arrays carry their length in bytes.
template <class Fill>
void putSized(std::string& out, Fill fill) {
  std::string body;
  fill(body);
  put(out, static_cast<std::uint32_t>(body.size()));
  out.append(body);
}

void putCounts(std::string& out, const std::map<std::uint16_t, std::uint64_t>& counts) {
  putSized(out, [&](std::string& body) {
    for (const auto& [key, value] : counts) {
      put(body, key);
      put(body, value);
    }
  });
}

}  // namespace

std::uint32_t crc32(std::string_view bytes, std::uint32_t crc) {
  return static_cast<std::uint32_t>(
      ::crc32_z(crc, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

void append(std::string& out, const Header& record) {
  const RecordScope scope(out, Opcode::Header);
  putText(out, record.profile);
  putText(out, record.library);
}

void appendFooter(std::string& out, Footer record, std::string_view summary) {
  const std::size_t start = out.size();
  const RecordScope scope(out, Opcode::Footer);
  put(out, record.summary_start);
  put(out, record.summary_offset_start);
  // The CRC covers the record's head too, whose length stands before the content does.
  std::string covered = out.substr(start);
  covered[1] = static_cast<char>(kFooterBytes);
  put(out, crc32(covered, crc32(summary)));
}

void append(std::string& out, const Schema& record) {
  const RecordScope scope(out, Opcode::Schema);
  put(out, record.id);
  putText(out, record.name);
  putText(out, record.encoding);
  putText(out, record.data);
}

void append(std::string& out, const Channel& record) {
  const RecordScope scope(out, Opcode::Channel);
  put(out, record.id);
  put(out, record.schema_id);
  putText(out, record.topic);
  putText(out, record.message_encoding);
  putSized(out, [&](std::string& body) {
    for (const auto& [key, value] : record.metadata) {
      putText(body, key);
      putText(body, value);
    }
  });
}

void append(std::string& out, const Message& record) {
  const RecordScope scope(out, Opcode::Message);
  put(out, record.channel_id);
  put(out, record.sequence);
  put(out, record.log_time);
  put(out, record.publish_time);
  out.append(record.data);
}

void append(std::string& out, const Chunk& record) {
  const RecordScope scope(out, Opcode::Chunk);
  put(out, record.start_time);
  put(out, record.end_time);
  put(out, record.uncompressed_size);
  put(out, record.uncompressed_crc);
  putText(out, record.compression);
  put(out, static_cast<std::uint64_t>(record.records.size()));
  out.append(record.records);
}

void append(std::string& out, const MessageIndex& record) {
  const RecordScope scope(out, Opcode::MessageIndex);
  put(out, record.channel_id);
  put(out, static_cast<std::uint32_t>(record.entries.size() * 16));
  for (const auto& [log_time, offset] : record.entries) {
    put(out, log_time);
    put(out, offset);
  }
}

void append(std::string& out, const ChunkIndex& record) {
  const RecordScope scope(out, Opcode::ChunkIndex);
  put(out, record.start_time);
  put(out, record.end_time);
  put(out, record.offset);
  put(out, record.length);
  putCounts(out, record.message_index_offsets);
  put(out, record.message_index_length);
  putText(out, record.compression);
  put(out, record.compressed_size);
  put(out, record.uncompressed_size);
}

void append(std::string& out, const Attachment& record) {
  const RecordScope scope(out, Opcode::Attachment);
  const std::size_t start = out.size();
  put(out, record.log_time);
  put(out, record.create_time);
  putText(out, record.name);
  putText(out, record.media_type);
  put(out, static_cast<std::uint64_t>(record.data.size()));
  out.append(record.data);
  put(out, crc32(std::string_view(out).substr(start)));
}

void append(std::string& out, const AttachmentIndex& record) {
  const RecordScope scope(out, Opcode::AttachmentIndex);
  put(out, record.offset);
  put(out, record.length);
  put(out, record.log_time);
  put(out, record.create_time);
  put(out, record.data_size);
  putText(out, record.name);
  putText(out, record.media_type);
}

void append(std::string& out, const Statistics& record) {
  const RecordScope scope(out, Opcode::Statistics);
  put(out, record.message_count);
  put(out, record.schema_count);
  put(out, record.channel_count);
  put(out, record.attachment_count);
  put(out, record.metadata_count);
  put(out, record.chunk_count);
  put(out, record.start_time);
  put(out, record.end_time);
  putCounts(out, record.channel_message_counts);
}

void append(std::string& out, const SummaryOffset& record) {
  const RecordScope scope(out, Opcode::SummaryOffset);
  put(out, static_cast<std::uint8_t>(record.group));
  put(out, record.start);
  put(out, record.length);
}

void appendDataEnd(std::string& out, std::uint32_t data_section_crc) {
  const RecordScope scope(out, Opcode::DataEnd);
  put(out, data_section_crc);
}

}  // namespace kiln::mcap
