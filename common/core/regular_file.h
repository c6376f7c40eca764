#pragma once

#include <cstdint>
#include <string>

#include "common/core/error.h"

namespace kiln {

/// The whole of a regular file. Pipes, folders and devices are refused without waiting for them.
/// Error: NotFound; InvalidInput for what is no regular file or longer than `most_bytes`; Storage
/// when it cannot be read. Each names the file.
[[nodiscard]] Result<std::string> readRegularFile(const std::string& path,
                                                  std::uint64_t most_bytes);

}  // namespace kiln
