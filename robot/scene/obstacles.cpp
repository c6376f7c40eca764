#include "robot/scene/obstacles.h"

#include "common/robot_model/robot_calibration.h"

namespace kiln {

std::vector<BoxConfig> obstacles(const ArenaMap& arena) {
  std::vector<BoxConfig> boxes = arena.walls;
  boxes.insert(boxes.end(), arena.furniture.begin(), arena.furniture.end());
  for (const auto& [mission, site] : arena.fixtures)
    boxes.insert(boxes.end(), site.boxes.begin(), site.boxes.end());
  return boxes;
}

std::vector<BoxConfig> obstacles(std::span<const KnownBrick> bricks) {
  std::vector<BoxConfig> boxes;
  for (const KnownBrick& brick : bricks)
    boxes.push_back({brick.name,
                     poseConfig(brick.X_frame_brick),
                     {brickShape(brick.kind).length_m, kBrickSide_m, kBrickSide_m}});
  return boxes;
}

}  // namespace kiln
