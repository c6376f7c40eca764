#include "robot/drivers/lepton/codec/picture_size.h"

namespace kiln::lepton {
namespace {

/// @pre at + count lies within `bytes`.
std::uint32_t number(std::string_view bytes, std::size_t at, std::size_t count, bool big) {
  std::uint32_t out = 0;
  for (std::size_t i = 0; i < count; ++i)
    out = out << 8U | static_cast<std::uint8_t>(bytes[at + (big ? i : count - 1 - i)]);
  return out;
}

/// PNG (ISO 15948) section 11.2.2: the header is the first chunk.
std::optional<PictureSize> pngSize(std::string_view bytes) {
  if (bytes.size() < 24 || bytes.substr(12, 4) != "IHDR") return std::nullopt;
  return PictureSize{number(bytes, 16, 4, true), number(bytes, 20, 4, true)};
}

/// TIFF 6.0 section 2: entries of 12 bytes {tag, type, count, value}.
std::optional<PictureSize> tiffSize(std::string_view bytes) {
  constexpr std::uint32_t kWidthTag = 256, kHeightTag = 257, kShort = 3, kLong = 4;
  const bool big = bytes[0] == 'M';
  if (bytes.size() < 8) return std::nullopt;
  const std::size_t page = number(bytes, 4, 4, big);
  if (page > bytes.size() || bytes.size() - page < 2) return std::nullopt;
  const std::size_t entries = number(bytes, page, 2, big);
  PictureSize size;
  for (std::size_t i = 0; i < entries; ++i) {
    const std::size_t at = page + 2 + 12 * i;
    if (at + 12 > bytes.size()) return std::nullopt;
    const std::uint32_t tag = number(bytes, at, 2, big), type = number(bytes, at + 2, 2, big);
    if (type != kShort && type != kLong) continue;
    const std::uint32_t value = number(bytes, at + 8, type == kShort ? 2 : 4, big);
    if (tag == kWidthTag) size.width = value;
    if (tag == kHeightTag) size.height = value;
  }
  if (size.width == 0 || size.height == 0) return std::nullopt;
  return size;
}

bool isTiff(std::string_view bytes) {
  using namespace std::string_view_literals;
  return bytes.starts_with("II*\0"sv) || bytes.starts_with("MM\0*"sv);
}

}  // namespace

std::optional<PictureSize> pictureSize(std::string_view bytes) {
  if (bytes.starts_with("\x89PNG\r\n\x1a\n")) return pngSize(bytes);
  if (isTiff(bytes)) return tiffSize(bytes);
  return std::nullopt;
}

std::size_t pictureCount(std::string_view bytes) {
  if (!isTiff(bytes) || bytes.size() < 8) return 1;
  constexpr std::size_t kMost = 1000;  // a chain that leads back into itself ends too
  const bool big = bytes[0] == 'M';
  std::size_t pages = 0;
  for (std::size_t page = number(bytes, 4, 4, big); page != 0 && pages < kMost;) {
    if (page > bytes.size() || bytes.size() - page < 2) break;
    ++pages;
    const std::size_t next = page + 2 + 12 * std::size_t{number(bytes, page, 2, big)};
    if (next > bytes.size() || bytes.size() - next < 4) break;
    page = number(bytes, next, 4, big);
  }
  return pages == 0 ? 1 : pages;
}

}  // namespace kiln::lepton
