#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace kiln {

inline constexpr std::size_t kMaxNameChars = 64;    ///< names and identifiers from outside
inline constexpr std::size_t kMaxTextChars = 2000;  ///< sentences, log lines

/// Any bytes as valid UTF-8; what is none becomes '?'.
[[nodiscard]] std::string validUtf8(std::string_view bytes);

/// Any bytes as one line of at most `most` printable characters of valid UTF-8. Line feeds and
/// tabs become spaces; every other control, format (bidi, zero-width), invisible, private or
/// undefined character becomes '?', so that no text from outside can forge a line, drive a terminal
/// or look like another one. A longer text ends in "…".
[[nodiscard]] std::string printable(std::string_view bytes, std::size_t most = kMaxTextChars);

/// printable(), at most kMaxNameChars, no space at either end.
[[nodiscard]] std::string printableName(std::string_view bytes);

}  // namespace kiln
