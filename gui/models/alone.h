#pragma once

#include <QString>

#include "common/model/status.h"

namespace kiln::gui {

/// What the robot does while it hears no station, by its own policy (architecture.md section 6):
/// "its mission GOES ON by itself: ...". @param last  what was heard of it last.
[[nodiscard]] QString whatItDoesAlone(const RobotStatus& last);

}  // namespace kiln::gui
