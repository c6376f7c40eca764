#include "robot/missions/fire/states/finished.h"

namespace kiln {

void Finished::enter() {
  context().haltAll(now());
  display("the fire got its water");
}

}  // namespace kiln
