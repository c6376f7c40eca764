#pragma once

#include <vector>

#include "common/model/mission.h"
#include "common/model/scene.h"
#include "robot/missions/wall/wall_context.h"

/// How the wall mission describes itself: the one place for its ids.
namespace kiln::wall {

[[nodiscard]] MissionInfo missionInfo();
[[nodiscard]] std::vector<Figure> figures(const WallContext& context);
/// Pile and wall as boxes where they are believed to be, in the order of building, and what was
/// found of them.
[[nodiscard]] std::vector<SceneItem> sceneItems(const WallContext& context);

}  // namespace kiln::wall
