#pragma once

#include <optional>
#include <string>

#include "robot/missions/fire/fire_context.h"

namespace kiln {

/// What both spraying phases share: feeds the pumps and watches them.
/// @return why the pumps must be taken as broken, if so.
[[nodiscard]] std::optional<std::string> keepSpraying(FireContext& context, Stamp now,
                                                      Duration time_in_state);

/// Seconds in which `litres` should have been sprayed, with the configured slack.
[[nodiscard]] double sprayTimeLimit(const FireContext& context, double litres);

/// Litres at this place at which phase 1 ends.
[[nodiscard]] double steadyLitres(const FireContext& context);

}  // namespace kiln
