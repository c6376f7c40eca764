#pragma once

#include <string>

#include "common/core/error.h"

namespace kiln {

/// Replaces a regular file (a link's target, never a device, pipe or folder) by the whole text or
/// not at all: temporary file, fsync, rename. Error: Storage, with the system's reason.
/// @param durable  false skips both fsyncs: survives kill -9 of the process, not a power cut.
[[nodiscard]] Result<void> writeFileAtomically(const std::string& path, const std::string& text,
                                               bool durable = true);

}  // namespace kiln
