#include "common/wire/jpeg_size.h"

#include <cstdint>

namespace kiln {

std::optional<PictureSize> jpegSize(std::string_view jpeg) {
  const auto byte = [jpeg](std::size_t i) { return static_cast<std::uint8_t>(jpeg[i]); };
  const auto word = [byte](std::size_t i) { return byte(i) << 8 | byte(i + 1); };
  if (jpeg.size() < 4 || word(0) != 0xFFD8) return std::nullopt;
  std::size_t at = 2;
  while (at + 9 <= jpeg.size()) {
    if (byte(at) != 0xFF) return std::nullopt;
    const int marker = byte(at + 1);
    // Start of frame: C0 to CF without the tables DHT, JPG and DAC.
    const bool frame =
        marker >= 0xC0 && marker <= 0xCF && marker != 0xC4 && marker != 0xC8 && marker != 0xCC;
    if (frame) {
      const PictureSize size{word(at + 7), word(at + 5)};
      if (size.width == 0 || size.height == 0) return std::nullopt;
      return size;
    }
    if (marker == 0xFF) {  // fill byte
      ++at;
      continue;
    }
    at += 2 + static_cast<std::size_t>(word(at + 2));
  }
  return std::nullopt;
}

}  // namespace kiln
