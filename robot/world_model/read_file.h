#pragma once

#include <string>

#include "common/core/error.h"

namespace kiln {

/// The whole file. Error{NotFound} when it does not exist, Error{Storage} when it cannot be read.
[[nodiscard]] Result<std::string> readWholeFile(const std::string& path);

}  // namespace kiln
