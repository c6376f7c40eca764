#include "robot/drivers/velodyne/link/frame_file.h"

#include <algorithm>
#include <cmath>

namespace kiln::velodyne {
namespace {

constexpr std::size_t kLargestFrame = 262'144;  // libpcap's largest snap length
constexpr std::size_t kLargestBlock = kLargestFrame + 65'536;
constexpr std::uint32_t kSection = 0x0A0D0D0A, kInterface = 1, kOldPacket = 2, kSimplePacket = 3,
                        kEnhancedPacket = 6;
constexpr std::uint32_t kByteOrder = 0x1A2B3C4D, kMicroseconds = 0xA1B2C3D4,
                        kNanoseconds = 0xA1B23C4D;

std::int64_t toNanoseconds(std::uint64_t ticks, std::uint64_t ticks_per_s, std::int64_t offset_s) {
  const auto whole = static_cast<std::int64_t>(ticks / ticks_per_s % 100'000'000'000u);
  const double rest = static_cast<double>(ticks % ticks_per_s) / static_cast<double>(ticks_per_s);
  constexpr std::int64_t kFarthest_s = 9'000'000'000;  // fits into 64 bits of nanoseconds
  return std::clamp(whole + std::clamp(offset_s, -kFarthest_s, kFarthest_s), -kFarthest_s,
                    kFarthest_s) *
             1'000'000'000 +
         std::llround(rest * 1e9);
}

}  // namespace

tl::unexpected<Error> FrameFile::damaged(const char* why) const {
  return makeError(ErrorCode::Truncated,
                   "{}: cut off or damaged in packet {} at byte {} ({}); copy or record the file "
                   "again",
                   path_, frames_ + 1, at_, why);
}

bool FrameFile::read(std::vector<std::uint8_t>& out, std::size_t bytes) {
  out.resize(bytes);
  in_.read(reinterpret_cast<char*>(out.data()), static_cast<std::streamsize>(bytes));
  return static_cast<std::size_t>(in_.gcount()) == bytes;
}

std::uint64_t FrameFile::number(const std::vector<std::uint8_t>& from, std::size_t at,
                                std::size_t bytes) const {
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < bytes; ++i)
    value = value << 8 | from[big_endian_ ? at + i : at + bytes - 1 - i];
  return value;
}

Result<void> FrameFile::open() {
  in_ = std::ifstream(path_, std::ios::binary | std::ios::ate);
  if (!in_)
    return makeError(ErrorCode::NotFound, "{}: cannot be opened; check its permissions", path_);
  size_ = static_cast<std::uint64_t>(in_.tellg());
  in_.seekg(0);
  at_ = frames_ = 0;
  interfaces_.clear();
  std::vector<std::uint8_t> head;
  constexpr std::size_t kHead = 24;  // of pcap; the smallest section head has 28
  if (!read(head, kHead)) {
    return makeError(ErrorCode::Truncated,
                     "{}: not a readable capture (its head is cut off); record it again with "
                     "tcpdump -w",
                     path_);
  }
  big_endian_ = true;
  std::uint64_t magic = number(head, 0, 4);
  pcapng_ = magic == kSection;
  if (pcapng_) {
    in_.seekg(0);
    return {};
  }
  big_endian_ = magic == kMicroseconds || magic == kNanoseconds;
  magic = number(head, 0, 4);
  Interface only;
  only.link = static_cast<int>(number(head, 20, 4) & 0xFFFF);
  if (magic == kNanoseconds) only.ticks_per_s = 1'000'000'000;
  interfaces_.push_back(only);
  at_ = kHead;
  return {};
}

Result<std::optional<CapturedFrame>> FrameFile::next() {
  return pcapng_ ? nextPcapng() : nextPcap();
}

Result<std::optional<CapturedFrame>> FrameFile::nextPcap() {
  constexpr std::size_t kHead = 16;
  if (at_ >= size_) return std::nullopt;
  std::vector<std::uint8_t> head;
  if (!read(head, kHead)) return damaged("its head ends early");
  CapturedFrame frame;
  const std::size_t here = number(head, 8, 4);
  if (here > kLargestFrame) return damaged("it claims to be larger than 256 KiB");
  if (!read(frame.bytes, here)) return damaged("it ends early");
  const Interface& from = interfaces_.front();
  frame.number = ++frames_;
  frame.time_ns = static_cast<std::int64_t>(number(head, 0, 4)) * 1'000'000'000 +
                  toNanoseconds(number(head, 4, 4), from.ticks_per_s, 0);
  frame.link = from.link;
  frame.wire_bytes = number(head, 12, 4);
  at_ += kHead + here;
  return frame;
}

Result<std::optional<FrameFile::Block>> FrameFile::nextBlock() {
  constexpr std::size_t kHead = 12, kTail = 4;
  if (at_ >= size_) return std::nullopt;
  std::vector<std::uint8_t> head;
  if (!read(head, kHead)) return damaged("a block ends early");
  Block block;
  if (number(head, 0, 4) == kSection) {  // the same in either byte order
    if (auto begun = beginSection(head); !begun) return tl::make_unexpected(begun.error());
  }
  block.type = static_cast<std::uint32_t>(number(head, 0, 4));
  const std::uint64_t length = number(head, 4, 4);
  if (length < kHead || length > size_ - at_) return damaged("a block ends early");
  const bool wanted = block.type == kInterface || block.type == kOldPacket ||
                      block.type == kSimplePacket || block.type == kEnhancedPacket;
  if (wanted) {
    if (length > kLargestBlock) return damaged("a block claims to be larger than 320 KiB");
    in_.seekg(static_cast<std::streamoff>(at_ + 8));
    if (!read(block.body, length - 8 - kTail)) return damaged("a block ends early");
  }
  at_ += length;
  in_.seekg(static_cast<std::streamoff>(at_));
  return block;
}

Result<void> FrameFile::beginSection(const std::vector<std::uint8_t>& head) {
  big_endian_ = false;
  if (number(head, 8, 4) != kByteOrder) big_endian_ = true;
  if (number(head, 8, 4) != kByteOrder) return damaged("a section has no byte order");
  interfaces_.clear();
  return {};
}

Result<void> FrameFile::addInterface(const std::vector<std::uint8_t>& body) {
  constexpr std::size_t kFixed = 8;
  constexpr std::uint64_t kEnd = 0, kResolution = 9, kOffset = 14;
  if (body.size() < kFixed) return damaged("an interface ends early");
  Interface out;
  out.link = static_cast<int>(number(body, 0, 2));
  out.snap_length = number(body, 4, 4);
  for (std::size_t at = kFixed; at + 4 <= body.size();) {
    const std::uint64_t code = number(body, at, 2), length = number(body, at + 2, 2);
    at += 4;
    if (code == kEnd || length > body.size() - at) break;
    if (code == kResolution && length == 1) {
      const unsigned exponent = body[at] & 0x7Fu;
      const bool binary = (body[at] & 0x80u) != 0;
      if (exponent > (binary ? 62u : 18u)) return damaged("an interface has no sane clock");
      out.ticks_per_s = binary ? std::uint64_t{1} << exponent
                               : static_cast<std::uint64_t>(std::llround(std::pow(10, exponent)));
    }
    if (code == kOffset && length == 8)
      out.offset_s = static_cast<std::int64_t>(number(body, at, 8));
    at += (length + 3) / 4 * 4;
  }
  interfaces_.push_back(out);
  return {};
}

Result<CapturedFrame> FrameFile::frameOf(const Block& block) {
  const bool simple = block.type == kSimplePacket;
  const std::size_t fixed = simple ? 4 : 20;
  const auto& body = block.body;
  if (body.size() < fixed) return damaged("a packet block ends early");
  const std::size_t index = simple ? 0 : number(body, 0, block.type == kOldPacket ? 2 : 4);
  if (index >= interfaces_.size()) return damaged("a packet names an interface that is not there");
  const Interface& from = interfaces_[index];
  CapturedFrame frame;
  frame.number = ++frames_;
  frame.link = from.link;
  std::size_t here = 0;
  if (simple) {
    frame.wire_bytes = here = number(body, 0, 4);
    if (from.snap_length > 0) here = std::min(here, from.snap_length);
  } else {
    const std::uint64_t ticks = number(body, 4, 4) << 32 | number(body, 8, 4);
    frame.time_ns = toNanoseconds(ticks, from.ticks_per_s, from.offset_s);
    here = number(body, 12, 4);
    frame.wire_bytes = number(body, 16, 4);
  }
  if (here > body.size() - fixed) return damaged("a packet is longer than its block");
  const auto begin = body.begin() + static_cast<std::ptrdiff_t>(fixed);
  frame.bytes.assign(begin, begin + static_cast<std::ptrdiff_t>(here));
  return frame;
}

Result<std::optional<CapturedFrame>> FrameFile::nextPcapng() {
  for (;;) {
    const auto block = nextBlock();
    if (!block) return tl::make_unexpected(block.error());
    if (!*block) return std::nullopt;
    if ((*block)->type == kInterface) {
      if (auto added = addInterface((*block)->body); !added)
        return tl::make_unexpected(added.error());
    } else if (!(*block)->body.empty()) {
      auto frame = frameOf(**block);
      if (!frame) return tl::make_unexpected(frame.error());
      return std::move(*frame);
    }
  }
}

}  // namespace kiln::velodyne
