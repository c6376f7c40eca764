#include "common/transport/frame.h"

namespace kiln {
namespace {

void put(std::string& out, std::uint64_t value) {
  for (int shift = 0; shift < 64; shift += 8) out += static_cast<char>((value >> shift) & 0xFFu);
}
std::uint64_t get(std::string_view bytes, std::size_t at) {
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < 8; ++i) {
    value |= std::uint64_t{static_cast<std::uint8_t>(bytes[at + i])} << (8 * i);
  }
  return value;
}

}  // namespace

std::string encodeFrameHeader(const FrameHeader& header) {
  std::string out;
  out.reserve(kFrameHeaderBytes);
  put(out, header.seq);
  put(out, static_cast<std::uint64_t>(header.published_ns));
  put(out, header.dropped_before);
  return out;
}

Result<FrameHeader> decodeFrameHeader(std::string_view bytes) {
  if (bytes.size() != kFrameHeaderBytes) {
    return makeError(ErrorCode::Truncated,
                     "published message: header of {} bytes, {} are due; dropped", bytes.size(),
                     kFrameHeaderBytes);
  }
  return FrameHeader{get(bytes, 0), static_cast<std::int64_t>(get(bytes, 8)), get(bytes, 16)};
}

std::uint64_t SequenceCounter::next(std::uint64_t seq) {
  const std::uint64_t gap = last_ != 0 && seq > last_ ? seq - last_ - 1 : 0;
  last_ = seq;
  lost_ += gap;
  return gap;
}

}  // namespace kiln
