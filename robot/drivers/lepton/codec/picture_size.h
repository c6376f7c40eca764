#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

namespace kiln::lepton {

struct PictureSize {
  std::uint32_t width = 0, height = 0;  ///< pixels
};

/// What a PNG or the first page of a TIFF says of its size, without decoding it; nullopt: neither,
/// or cut off before that.
[[nodiscard]] std::optional<PictureSize> pictureSize(std::string_view bytes);

/// Pages of a TIFF, at most 1000; 1 for everything else.
[[nodiscard]] std::size_t pictureCount(std::string_view bytes);

}  // namespace kiln::lepton
