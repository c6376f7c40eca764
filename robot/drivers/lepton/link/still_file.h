#pragma once

#include <string>
#include <vector>

#include "robot/drivers/lepton/codec/lepton_frame.h"

namespace kiln::lepton {

/// One thermal still: .tjsn with telemetry, or a 16-bit greyscale .png, .tif or .tiff (telemetry
/// only in the 160 x 122 format; the first page of several). Error: NotFound, InvalidInput or Truncated with the file's name
/// and what to do.
[[nodiscard]] Result<LeptonFrame> readStill(const std::string& path);

/// The stills of a folder, sorted by name. A picture beside a .tjsn of the same name is the same
/// frame without its telemetry and is left out, and so are hidden files. Error: NotFound if there is no such folder or it
/// holds no still.
[[nodiscard]] Result<std::vector<std::string>> listStills(const std::string& folder);

}  // namespace kiln::lepton
