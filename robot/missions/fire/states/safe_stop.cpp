#include "robot/missions/fire/states/safe_stop.h"

namespace kiln {

void SafeStop::enter() {
  context().haltAll(now());
  display("everything rests; take over by hand or force a state to go on");
}

}  // namespace kiln
