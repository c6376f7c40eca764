#pragma once

#include <string_view>

#include "common/record/record_writer.h"

namespace kiln {

/// The schema of a message of proto/kiln/v1 or proto/foxglove by its full name
/// ("kiln.v1.RobotStatus"): a FileDescriptorSet with every file it needs. Error: NotFound.
[[nodiscard]] Result<RecordSchema> protobufSchema(std::string_view message);

}  // namespace kiln
