#pragma once

#include <nlohmann/json_fwd.hpp>

#include "common/core/error.h"
#include "robot/world_model/world_state.h"

namespace kiln {

[[nodiscard]] nlohmann::json worldToJson(const WorldState& world);
/// Error{InvalidInput}: names the first key that is missing, of the wrong type or not finite.
[[nodiscard]] Result<WorldState> worldFromJson(const nlohmann::json& json);

}  // namespace kiln
