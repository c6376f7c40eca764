#include "robot/scene/obstacles.h"

namespace kiln {

std::vector<BoxConfig> obstacles(const ArenaMap& arena) {
  std::vector<BoxConfig> boxes = arena.walls;
  boxes.insert(boxes.end(), arena.furniture.begin(), arena.furniture.end());
  for (const auto& [mission, site] : arena.fixtures)
    boxes.insert(boxes.end(), site.boxes.begin(), site.boxes.end());
  return boxes;
}

}  // namespace kiln
