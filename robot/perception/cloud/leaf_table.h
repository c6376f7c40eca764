#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace kiln {

/// Index by leaf of a voxel grid. Open addressing over 2^k slots, at most half full.
/// Thread-compatible.
class LeafTable {
 public:
  static constexpr std::uint32_t kNone = 0xffffffffU;

  /// @param expected  keys that will be stored at most.
  explicit LeafTable(std::size_t expected)
      : slots_(std::bit_ceil(expected < 8 ? std::size_t{16} : 2 * expected), {kEmpty, 0}) {}
  /// Index stored for `key`, or `fresh` after storing it. @pre key is not ~0
  std::uint32_t find(std::uint64_t key, std::uint32_t fresh) {
    std::size_t i = first(key);
    while (slots_[i].key != key) {
      if (slots_[i].key == kEmpty) {
        slots_[i] = {key, fresh};
        return fresh;
      }
      i = (i + 1) & (slots_.size() - 1);
    }
    return slots_[i].index;
  }
  /// Index stored for `key`, or kNone.
  [[nodiscard]] std::uint32_t get(std::uint64_t key) const {
    std::size_t i = first(key);
    while (slots_[i].key != key) {
      if (slots_[i].key == kEmpty) return kNone;
      i = (i + 1) & (slots_.size() - 1);
    }
    return slots_[i].index;
  }

 private:
  static constexpr std::uint64_t kEmpty = ~std::uint64_t{0};
  struct Slot {
    std::uint64_t key;
    std::uint32_t index;
  };
  [[nodiscard]] std::size_t first(std::uint64_t key) const {
    return (key * 0x9E3779B97F4A7C15ull >> 20) & (slots_.size() - 1);
  }
  std::vector<Slot> slots_;
};

}  // namespace kiln
