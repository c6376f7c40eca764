#include "common/core/text.h"

#include <algorithm>
#include <array>
#include <cstdint>

namespace kiln {
namespace {

struct Range {
  char32_t first, last;
};

/// Unicode 15: general categories Cc, Cf, Co, Cs, Zl, Zp, and Default_Ignorable_Code_Point. Sorted.
constexpr std::array kUnprintable{
    Range{0x0000, 0x001F},   Range{0x007F, 0x009F},   Range{0x00AD, 0x00AD},
    Range{0x034F, 0x034F},   Range{0x0600, 0x0605},   Range{0x061C, 0x061C},
    Range{0x06DD, 0x06DD},   Range{0x070F, 0x070F},   Range{0x0890, 0x0891},
    Range{0x08E2, 0x08E2},   Range{0x115F, 0x1160},   Range{0x17B4, 0x17B5},
    Range{0x180B, 0x180F},   Range{0x200B, 0x200F},   Range{0x2028, 0x202E},
    Range{0x2060, 0x206F},   Range{0x2800, 0x2800},   Range{0x3164, 0x3164},
    Range{0xD800, 0xF8FF},   Range{0xFDD0, 0xFDEF},   Range{0xFE00, 0xFE0F},
    Range{0xFEFF, 0xFEFF},   Range{0xFFA0, 0xFFA0},   Range{0xFFF0, 0xFFFB},
    Range{0xFFFE, 0xFFFF},   Range{0x110BD, 0x110BD}, Range{0x110CD, 0x110CD},
    Range{0x13430, 0x1343F}, Range{0x1BCA0, 0x1BCA3}, Range{0x1D173, 0x1D17A},
    Range{0x1FFFE, 0x1FFFF}, Range{0x2FFFE, 0x2FFFF}, Range{0x3FFFE, 0x10FFFF},
};

bool isPrintable(char32_t c) {
  const auto* range = std::lower_bound(kUnprintable.begin(), kUnprintable.end(), c,
                                       [](const Range& r, char32_t x) { return r.last < x; });
  return range == kUnprintable.end() || c < range->first;
}

/// Length of the valid UTF-8 sequence at the front of `text`, 0 if there is none.
std::size_t sequenceLength(std::string_view text) {
  const auto byte = [text](std::size_t i) { return static_cast<std::uint8_t>(text[i]); };
  const std::uint8_t lead = byte(0);
  if (lead < 0x80) return 1;
  const std::size_t length = lead >= 0xF0 ? 4 : lead >= 0xE0 ? 3 : 2;
  if (lead < 0xC2 || lead > 0xF4 || text.size() < length) return 0;
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xC0) != 0x80) return 0;
  }
  // Overlong forms, surrogates and code points above U+10FFFF.
  const std::uint8_t second = byte(1);
  if ((lead == 0xE0 && second < 0xA0) || (lead == 0xED && second > 0x9F) ||
      (lead == 0xF0 && second < 0x90) || (lead == 0xF4 && second > 0x8F)) {
    return 0;
  }
  return length;
}

/// Of a valid sequence.
char32_t codePoint(std::string_view sequence) {
  const auto lead = static_cast<std::uint8_t>(sequence[0]);
  char32_t c = sequence.size() == 1 ? lead : lead & (0xFFu >> (sequence.size() + 1));
  for (const char next : sequence.substr(1)) c = c << 6 | (static_cast<std::uint8_t>(next) & 0x3Fu);
  return c;
}

}  // namespace

std::string validUtf8(std::string_view bytes) {
  std::string out;
  out.reserve(bytes.size());
  while (!bytes.empty()) {
    const std::size_t length = sequenceLength(bytes);
    if (length == 0) {
      out += '?';
    } else {
      out.append(bytes.substr(0, length));
    }
    bytes.remove_prefix(std::max<std::size_t>(length, 1));
  }
  return out;
}

std::string printable(std::string_view bytes, std::size_t most) {
  std::string out;
  std::size_t last_char = 0;
  for (std::size_t chars = 0; !bytes.empty(); ++chars) {
    if (chars == most) return out.substr(0, last_char) + "…";
    last_char = out.size();
    const std::size_t length = sequenceLength(bytes);
    const std::string_view sequence = bytes.substr(0, std::max<std::size_t>(length, 1));
    if (sequence == "\n" || sequence == "\t" || sequence == "\r") {
      out += ' ';
    } else if (length == 0 || !isPrintable(codePoint(sequence))) {
      out += '?';
    } else {
      out += sequence;
    }
    bytes.remove_prefix(sequence.size());
  }
  return out;
}

std::string printableName(std::string_view bytes) {
  constexpr const char* kSpaces = " \t\r\n";
  const auto first = std::min(bytes.find_first_not_of(kSpaces), bytes.size());
  bytes = bytes.substr(first, bytes.find_last_not_of(kSpaces) + 1 - first);
  return printable(bytes, kMaxNameChars);
}

}  // namespace kiln
