#pragma once

#include <string>
#include <string_view>

#include "common/core/error.h"
#include "common/model/link.h"

/// model <-> command.proto: what the command and stop sockets carry. Decoders check form (known
/// kinds, enums, lengths, stamps and durations that can be) and clean names (core/text.h,
/// printableName); whether a number may be obeyed is the command gate's decision, so a NaN in a
/// setpoint passes here and is refused there.
namespace kiln::wire {

[[nodiscard]] std::string encode(const ToRobot& message);
[[nodiscard]] std::string encode(const ToStation& message);
[[nodiscard]] std::string encode(const StopRequest& request);
[[nodiscard]] std::string encode(const StopAck& ack);

[[nodiscard]] Result<ToRobot> decodeToRobot(std::string_view bytes);
[[nodiscard]] Result<ToStation> decodeToStation(std::string_view bytes);
[[nodiscard]] Result<StopRequest> decodeStopRequest(std::string_view bytes);
[[nodiscard]] Result<StopAck> decodeStopAck(std::string_view bytes);

}  // namespace kiln::wire
