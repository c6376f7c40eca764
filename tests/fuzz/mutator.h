#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <random>
#include <vector>

namespace kiln::fuzz {

using Bytes = std::vector<std::uint8_t>;

/// Damages inputs in the ways that find parser bugs; the same seed damages the same way on every
/// machine (no std:: distribution, whose results differ between libraries).
class Mutator {
 public:
  explicit Mutator(std::uint64_t seed) : random_(seed) {}

  [[nodiscard]] std::size_t below(std::size_t n) {
    return n == 0 ? 0 : static_cast<std::size_t>(random_() % n);
  }

  [[nodiscard]] Bytes random(std::size_t size) {
    Bytes out(size);
    for (auto& byte : out) byte = static_cast<std::uint8_t>(random_());
    return out;
  }

  /// One to four changes: flipped bits, extreme bytes, cut, repeated, removed or inserted pieces.
  [[nodiscard]] Bytes mutate(Bytes bytes) {
    for (std::size_t n = 1 + below(4); n > 0 && !bytes.empty(); --n) change(bytes);
    return bytes;
  }

 private:
  void change(Bytes& bytes) {
    const std::size_t at = below(bytes.size());
    const auto here = bytes.begin() + static_cast<std::ptrdiff_t>(at);
    switch (below(7)) {
      case 0:
        *here = static_cast<std::uint8_t>(*here ^ 1u << below(8));
        break;
      case 1:
        *here = kExtreme[below(kExtreme.size())];
        break;
      case 2:
        bytes.resize(at);
        break;
      case 3:
        bytes.erase(here, here + static_cast<std::ptrdiff_t>(
                                     1 + below(std::min<std::size_t>(16, bytes.size() - at))));
        break;
      case 4: {
        const Bytes junk = random(1 + below(16));
        bytes.insert(here, junk.begin(), junk.end());
        break;
      }
      case 5: {  // a field of four bytes that claims to be huge
        for (std::size_t i = at; i < std::min(at + 4, bytes.size()); ++i) bytes[i] = 0xFF;
        break;
      }
      default: {
        const Bytes piece(
            here, here + static_cast<std::ptrdiff_t>(std::min<std::size_t>(64, bytes.size() - at)));
        const auto to = bytes.begin() + static_cast<std::ptrdiff_t>(below(bytes.size()));
        bytes.insert(to, piece.begin(), piece.end());
        break;
      }
    }
  }

  static constexpr std::array<std::uint8_t, 6> kExtreme{0x00, 0x01, 0x7F, 0x80, 0xFE, 0xFF};
  std::mt19937_64 random_;
};

}  // namespace kiln::fuzz
