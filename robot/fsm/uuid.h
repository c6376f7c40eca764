#pragma once

#include <string>

namespace kiln {

/// A random (version 4) UUID, "3f0c…-4…": names one mission, so that a station notices a restarted
/// robot.
[[nodiscard]] std::string randomUuid();

}  // namespace kiln
