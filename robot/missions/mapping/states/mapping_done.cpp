#include "robot/missions/mapping/states/mapping_done.h"

namespace kiln {

void MappingDone::enter() {
  context().drive.cancel();
  display("back at the start; end the recording and make the map of it (kiln-eval map)");
}

}  // namespace kiln
