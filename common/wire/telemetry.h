#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "common/core/error.h"
#include "common/model/status.h"

/// model <-> telemetry.proto.
namespace kiln::wire {

[[nodiscard]] std::string encode(const RobotStatus& status);
[[nodiscard]] std::string encode(const std::vector<MacroInfo>& macros);
[[nodiscard]] std::string encode(const LogBatch& batch);

[[nodiscard]] Result<RobotStatus> decodeRobotStatus(std::string_view bytes);
[[nodiscard]] Result<std::vector<MacroInfo>> decodeMacros(std::string_view bytes);
[[nodiscard]] Result<LogBatch> decodeLogBatch(std::string_view bytes);

}  // namespace kiln::wire
