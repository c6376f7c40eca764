#pragma once

#include <string>

#include "common/core/error.h"
#include "kiln/v1/device.pb.h"
#include "robot/sim/world.h"

namespace kiln::sim {

/// Reads the commands of an Advance. Error names the field that is cut off; nothing is applied
/// then.
[[nodiscard]] Result<WorldCommands> fromProto(const v1::device::Advance& message);
/// Writes a report; sensor frames are copied into the message.
void toProto(const WorldReport& report, v1::device::Report& message);

}  // namespace kiln::sim
