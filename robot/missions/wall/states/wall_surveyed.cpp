#include "robot/missions/wall/states/wall_surveyed.h"

namespace kiln {

void WallSurveyed::enter() {
  context().halt();
  display("pile, bricks and marker are found; nothing is set yet");
}

}  // namespace kiln
