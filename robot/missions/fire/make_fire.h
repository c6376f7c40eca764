#pragma once

#include "robot/missions/common/mission_kind.h"

namespace kiln {

/// The fire mission's line in the catalogue.
[[nodiscard]] MissionKind fireMissionKind();

}  // namespace kiln
