#pragma once

#include <algorithm>
#include <string>
#include <string_view>

namespace kiln {

/// A word of a foreign file as it may stand in a message: at most 64 ASCII characters, each other
/// one a '?'.
[[nodiscard]] inline std::string printable(std::string_view word) {
  constexpr std::size_t kLongest = 64;
  std::string out(word.substr(0, kLongest));
  std::replace_if(
      out.begin(), out.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
  return out;
}

}  // namespace kiln
