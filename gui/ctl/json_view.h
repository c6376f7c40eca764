#pragma once

#include <optional>
#include <string>

#include <nlohmann/json.hpp>

#include "common/client/operator_session.h"

/// Model values as JSON objects and as lines for people. Angles in rad and in degrees where the key
/// says so.
namespace kiln::ctl {

[[nodiscard]] nlohmann::json toJson(const RobotStatus& status);
[[nodiscard]] nlohmann::json toJson(const FsmStatus& status);
[[nodiscard]] nlohmann::json toJson(const LinkReport& link);
[[nodiscard]] nlohmann::json toJson(const MacroInfo& macro);
[[nodiscard]] nlohmann::json toJson(const MissionInfo& info);
[[nodiscard]] nlohmann::json toJson(const Alarm& alarm);
[[nodiscard]] nlohmann::json toJson(const CommandUpdate& update);
[[nodiscard]] nlohmann::json toJson(const LocalizationStatus& status);
[[nodiscard]] std::string modeName(Mode mode);
/// "AUTO  AimHose (step 12)  lease anna  STOP -  pose 9.95 2.80 0 deg"
[[nodiscard]] std::string oneLine(const RobotStatus& status, const std::optional<FsmStatus>& fsm);

/// "good  0.012 m 0.3 deg  pose 9.95 2.80 m 0 deg  surfel map indoor  matched 0.1 s ago"
[[nodiscard]] std::string oneLine(const LocalizationStatus& status);

}  // namespace kiln::ctl
