#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace kiln {

/// Little-endian bytes of a map file. Columns of like values compress best.
class ByteWriter {
 public:
  void u8(std::uint8_t value) { bytes_.push_back(static_cast<char>(value)); }
  void u32(std::uint32_t value) { fixed(value, 4); }
  void u64(std::uint64_t value) { fixed(value, 8); }
  void f32(float value);
  void f64(double value);
  void varint(std::uint64_t value);
  void text(const std::string& value);
  [[nodiscard]] const std::string& bytes() const { return bytes_; }

 private:
  void fixed(std::uint64_t value, int size);
  std::string bytes_;
};

/// The reverse. A read past the end gives 0 and makes ok() false for good.
class ByteReader {
 public:
  explicit ByteReader(std::string_view bytes) : bytes_(bytes) {}
  [[nodiscard]] std::uint8_t u8() { return static_cast<std::uint8_t>(fixed(1)); }
  [[nodiscard]] std::uint32_t u32() { return static_cast<std::uint32_t>(fixed(4)); }
  [[nodiscard]] std::uint64_t u64() { return fixed(8); }
  [[nodiscard]] float f32();
  [[nodiscard]] double f64();
  [[nodiscard]] std::uint64_t varint();
  [[nodiscard]] std::string text(std::size_t max_size);
  [[nodiscard]] bool ok() const { return ok_; }
  [[nodiscard]] std::size_t left() const { return bytes_.size(); }

 private:
  [[nodiscard]] std::uint64_t fixed(int size);
  std::string_view bytes_;
  bool ok_ = true;
};

}  // namespace kiln
