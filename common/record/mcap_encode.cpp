#include "common/record/mcap_encode.h"

#include <zlib.h>

#include "common/record/mcap_fields.h"

namespace kiln::mcap {
namespace {

template <std::unsigned_integral Int>
void put(std::string& out, Int value) {
  for (std::size_t i = 0; i < sizeof(Int); ++i) {
    out.push_back(static_cast<char>((static_cast<std::uint64_t>(value) >> (8 * i)) & 0xFFu));
  }
}

void put(std::string& out, Opcode opcode) { put(out, static_cast<std::uint8_t>(opcode)); }

void put(std::string& out, const std::string& text) {
  put(out, static_cast<std::uint32_t>(text.size()));
  out.append(text);
}

/// Maps and lists.
template <class Pairs>
requires requires { typename Pairs::value_type::second_type; }
void put(std::string& out, const Pairs& pairs) {
  std::string body;
  for (const auto& [first, second] : pairs) {
    put(body, first);
    put(body, second);
  }
  put(out, body);
}

template <class Record>
void putFields(std::string& out, const Record& record) {
  std::apply([&](const auto&... field) { (put(out, field), ...); }, fields(record));
}

/// Writes opcode and a length that is filled in when the record is complete.
class RecordScope {
 public:
  RecordScope(std::string& out, Opcode opcode) : out_(out) {
    put(out_, opcode);
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

template <class Record>
void appendRecord(std::string& out, Opcode opcode, const Record& record) {
  const RecordScope scope(out, opcode);
  putFields(out, record);
}

}  // namespace

std::uint32_t crc32(std::string_view bytes, std::uint32_t crc) {
  return static_cast<std::uint32_t>(
      ::crc32_z(crc, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

void append(std::string& out, const Header& r) { appendRecord(out, Opcode::Header, r); }
void append(std::string& out, const Schema& r) { appendRecord(out, Opcode::Schema, r); }
void append(std::string& out, const Channel& r) { appendRecord(out, Opcode::Channel, r); }
void append(std::string& out, const MessageIndex& r) { appendRecord(out, Opcode::MessageIndex, r); }
void append(std::string& out, const ChunkIndex& r) { appendRecord(out, Opcode::ChunkIndex, r); }
void append(std::string& out, const AttachmentIndex& r) {
  appendRecord(out, Opcode::AttachmentIndex, r);
}
void append(std::string& out, const Statistics& r) { appendRecord(out, Opcode::Statistics, r); }
void append(std::string& out, const SummaryOffset& r) {
  appendRecord(out, Opcode::SummaryOffset, r);
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

void append(std::string& out, const Message& record) {
  const RecordScope scope(out, Opcode::Message);
  putFields(out, record);
  out.append(record.data);
}

void append(std::string& out, const Chunk& record) {
  const RecordScope scope(out, Opcode::Chunk);
  putFields(out, record);
  put(out, static_cast<std::uint64_t>(record.records.size()));
  out.append(record.records);
}

void append(std::string& out, const Attachment& record) {
  const RecordScope scope(out, Opcode::Attachment);
  const std::size_t start = out.size();
  putFields(out, record);
  put(out, static_cast<std::uint64_t>(record.data.size()));
  out.append(record.data);
  put(out, crc32(std::string_view(out).substr(start)));
}

void appendDataEnd(std::string& out, std::uint32_t data_section_crc) {
  const RecordScope scope(out, Opcode::DataEnd);
  put(out, data_section_crc);
}

}  // namespace kiln::mcap
