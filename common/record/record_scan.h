#pragma once

#include "common/record/record_index.h"

namespace kiln {

/// Index of a recording without a usable summary (cut off by a crash, still being written): walks
/// over the data section from record to record and stops at the first that is not whole.
[[nodiscard]] RecordIndex scanRecords(const RandomFile& file);

}  // namespace kiln
