#pragma once

#include <string>
#include <vector>

#include "common/core/error.h"

namespace kiln {

/// Every key must stand at the top of the YAML file: for what safety depends on no default is
/// believed. Error: InvalidInput, names file and key; or what readRegularFile() says.
[[nodiscard]] Result<void> requireKeys(const std::string& path,
                                       const std::vector<std::string>& keys);

}  // namespace kiln
