#pragma once

#include <string>
#include <string_view>

#include "common/core/error.h"
#include "common/model/mission.h"

/// model <-> mission.proto.
namespace kiln::wire {

[[nodiscard]] std::string encode(const MissionInfo& info);
[[nodiscard]] std::string encode(const MissionDetail& detail);
[[nodiscard]] Result<MissionInfo> decodeMissionInfo(std::string_view bytes);
[[nodiscard]] Result<MissionDetail> decodeMissionDetail(std::string_view bytes);

}  // namespace kiln::wire
