#pragma once

#include <string>

#include "common/core/error.h"
#include "kiln/v1/device.pb.h"
#include "robot/hal/device_set.h"
#include "robot/sim/world.h"

namespace kiln::sim {

/// Reads the commands of an Advance. Error names the field that is cut off; nothing is applied
/// then.
[[nodiscard]] Result<WorldCommands> fromProto(const v1::device::Advance& message);
/// Writes a report; sensor frames are copied into the message.
void toProto(const WorldReport& report, v1::device::Report& message);

[[nodiscard]] v1::device::Device toProto(DeviceKind kind);
/// The report and the commands of a robot that has `devices` alone.
void leaveOut(const DeviceSet& devices, v1::device::Report& report);
void leaveOut(const DeviceSet& devices, WorldCommands& commands);

}  // namespace kiln::sim
