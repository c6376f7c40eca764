#include "robot/missions/wall/states/wall_surveyed.h"

namespace kiln {

void WallSurveyed::enter() {
  context().halt();
  display("pile and marker are found; no brick is picked yet");
}

}  // namespace kiln
