#pragma once

#include "common/core/error.h"
#include "common/model/sensor.h"
#include "kiln/v1/telemetry.pb.h"

/// model <-> telemetry.proto's ArmState. For the .cpp files of this folder alone.
namespace kiln::wire {

void toProto(const ArmState& arm, v1::ArmState& out);
[[nodiscard]] Result<ArmState> fromProto(const v1::ArmState& in);

}  // namespace kiln::wire
