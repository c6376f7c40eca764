#pragma once

#include <optional>
#include <string_view>

namespace kiln {

struct PictureSize {
  int width = 0;
  int height = 0;
};

/// Size of a JPEG picture from its frame header (ITU T.81, B.2.2); nullopt if it is none.
[[nodiscard]] std::optional<PictureSize> jpegSize(std::string_view jpeg);

}  // namespace kiln
