#pragma once

#include <string>

#include "common/core/error.h"

namespace kiln {

/// Writes the whole text or nothing: temporary file beside `path`, fsync, rename, fsync of the
/// folder. Error: Storage, with the system's reason; an existing file stays as it was. Only regular
/// files are replaced, never a device, pipe or folder; where `path` is a link its target is.
/// @param durable  false skips both fsyncs: survives kill -9 of the process, not a power cut.
[[nodiscard]] Result<void> writeFileAtomically(const std::string& path, const std::string& text,
                                               bool durable = true);

}  // namespace kiln
