#pragma once

#include <string>

namespace kiln {

/// Top folder of the source tree and of the build. Functions, not macros on every compiler call:
/// the compiler cache then serves all checkouts.
[[nodiscard]] std::string sourceDir();
[[nodiscard]] std::string binaryDir();

}  // namespace kiln
