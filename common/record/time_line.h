#pragma once

#include "common/record/record_index.h"

namespace kiln {

/// Sets start, end and outliers of the index. A recorder whose clock was set in the middle, or one
/// message with a wrong stamp, must not stretch a run to years: messages that stand more than 60 s
/// before or behind all others are left out while they are at most 1 % of all (of ten messages or
/// more: at least one). Chunks get the times of what is left of them. Only chunks that span more
/// than 60 s are unpacked for it, and only where the chunks do not follow each other closely.
void findTimeLine(const RandomFile& file, RecordIndex& index);

}  // namespace kiln
