#pragma once

#include <string_view>

#include "robot/drivers/lepton/codec/lepton_frame.h"

namespace kiln::lepton {

/// A tCam picture file (.tjsn): JSON with `metadata`, `radiometric` (160 x 120 words) and
/// `telemetry` (240 words), the words base64-coded and little endian. Error: InvalidInput or
/// Truncated saying which part is missing or broken; the caller adds the file's name.
[[nodiscard]] Result<LeptonFrame> parseTjsn(std::string_view text);

}  // namespace kiln::lepton
