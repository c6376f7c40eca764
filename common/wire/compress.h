#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "common/core/error.h"

namespace kiln::wire {

/// zstd level 1: the best ratio for its time on clouds and thermal frames (level 3 gains nothing).
[[nodiscard]] std::string compress(std::string_view raw);

/// @param expected_size exact size of the original; a frame that declares or yields another size is
/// refused before
///        anything of its own size is allocated.
/// @param what          named in the error: "cloud xyz".
[[nodiscard]] Result<std::string> decompress(std::string_view packed, std::size_t expected_size,
                                             const char* what);

}  // namespace kiln::wire
