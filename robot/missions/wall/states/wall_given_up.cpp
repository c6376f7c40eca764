#include "robot/missions/wall/states/wall_given_up.h"

namespace kiln {

void WallGivenUp::enter() {
  context().halt();
  display("everything rests; take over by hand or force a state to go on");
}

}  // namespace kiln
