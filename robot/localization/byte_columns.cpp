#include "robot/localization/byte_columns.h"

#include <bit>

namespace kiln {

void ByteWriter::fixed(std::uint64_t value, int size) {
  for (int i = 0; i < size; ++i) u8(static_cast<std::uint8_t>(value >> (8 * i)));
}

void ByteWriter::f32(float value) { u32(std::bit_cast<std::uint32_t>(value)); }

void ByteWriter::f64(double value) { u64(std::bit_cast<std::uint64_t>(value)); }

void ByteWriter::varint(std::uint64_t value) {
  for (; value >= 0x80; value >>= 7U) u8(static_cast<std::uint8_t>(value | 0x80U));
  u8(static_cast<std::uint8_t>(value));
}

void ByteWriter::text(const std::string& value) {
  u32(static_cast<std::uint32_t>(value.size()));
  bytes_ += value;
}

std::uint64_t ByteReader::fixed(int size) {
  if (bytes_.size() < static_cast<std::size_t>(size)) {
    ok_ = false;
    bytes_ = {};
    return 0;
  }
  std::uint64_t value = 0;
  for (int i = 0; i < size; ++i) {
    value |=
        static_cast<std::uint64_t>(static_cast<std::uint8_t>(bytes_[static_cast<std::size_t>(i)]))
        << (8 * i);
  }
  bytes_.remove_prefix(static_cast<std::size_t>(size));
  return value;
}

float ByteReader::f32() { return std::bit_cast<float>(u32()); }

double ByteReader::f64() { return std::bit_cast<double>(u64()); }

std::uint64_t ByteReader::varint() {
  std::uint64_t value = 0;
  for (unsigned shift = 0; shift < 64; shift += 7) {
    const std::uint8_t byte = u8();
    value |= static_cast<std::uint64_t>(byte & 0x7fU) << shift;
    if ((byte & 0x80U) == 0) return value;
  }
  ok_ = false;
  return 0;
}

std::string ByteReader::text(std::size_t max_size) {
  const std::size_t size = u32();
  if (size > max_size || size > bytes_.size()) {
    ok_ = false;
    return {};
  }
  std::string out(bytes_.substr(0, size));
  bytes_.remove_prefix(size);
  return out;
}

}  // namespace kiln
