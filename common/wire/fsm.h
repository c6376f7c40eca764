#pragma once

#include <string>
#include <string_view>

#include "common/core/error.h"
#include "common/model/fsm.h"

/// model <-> fsm.proto.
namespace kiln::wire {

[[nodiscard]] std::string encode(const FsmInfo& info);
[[nodiscard]] std::string encode(const FsmStatus& status);
[[nodiscard]] Result<FsmInfo> decodeFsmInfo(std::string_view bytes);
[[nodiscard]] Result<FsmStatus> decodeFsmStatus(std::string_view bytes);

}  // namespace kiln::wire
