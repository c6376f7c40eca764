#pragma once

#include <string>

#include "common/core/error.h"

namespace kiln {

enum class Durability {
  ProcessDeath,  ///< survives kill -9: temp file and rename
  PowerLoss,     ///< also fsync of file and folder
};

/// Replaces `path` by `text` so that a reader sees the old file or the new one, never a part:
/// writes `path`.tmp, then renames it. Error{Storage}: disk full, folder missing or not writable;
/// the old file then stands untouched.
[[nodiscard]] Result<void> writeFileAtomically(const std::string& path, const std::string& text,
                                               Durability durability);

/// Error{NotFound} when it does not exist, Error{Storage} when it cannot be read.
[[nodiscard]] Result<std::string> readWholeFile(const std::string& path);

}  // namespace kiln
