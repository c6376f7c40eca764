#include "robot/missions/mapping/states/mapping_given_up.h"

namespace kiln {

void MappingGivenUp::enter() {
  context().drive.cancel();
  display("everything rests; drive the rest of the round by hand, or start anew");
}

}  // namespace kiln
