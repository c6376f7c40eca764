#include "robot/missions/wall/states/wall_built.h"

namespace kiln {

void WallBuilt::enter() {
  context().halt();
  display("every brick of the blueprint is set");
}

}  // namespace kiln
