#pragma once

#include "common/core/error.h"
#include "common/model/command.h"
#include "kiln/v1/command.pb.h"

/// For command.cpp alone: the oneof of command bodies.
namespace kiln::wire {

void bodyToProto(const CommandBody& body, v1::Command& out);
[[nodiscard]] Result<CommandBody> bodyFromProto(const v1::Command& in);

}  // namespace kiln::wire
