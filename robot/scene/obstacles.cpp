#include "robot/scene/obstacles.h"

#include <utility>

namespace kiln {

std::vector<BoxConfig> obstacles(const ArenaMap& arena) {
  std::vector<BoxConfig> boxes = arena.walls;
  boxes.insert(boxes.end(), arena.furniture.begin(), arena.furniture.end());
  for (BoxConfig& box : arena.fireFurniture()) boxes.push_back(std::move(box));
  return boxes;
}

}  // namespace kiln
