#pragma once

#include <vector>

#include "common/model/mission.h"
#include "common/model/scene.h"

/// What the toy tells: one figure, one layer, one command, one panel.
namespace kiln::toy {

inline constexpr const char* kPush = "push";  ///< argument by, m: how much farther it drives

[[nodiscard]] MissionInfo missionInfo();
[[nodiscard]] std::vector<Figure> figures(int drives);
/// A box where it will end. @param X_map_goal  of the base
[[nodiscard]] std::vector<SceneItem> items(const Pose2& X_map_goal);

}  // namespace kiln::toy
