#include "robot/missions/mapping/states/mapping_blocked.h"

#include "robot/missions/mapping/states/mapping_given_up.h"
#include "robot/missions/mapping/states/mapping_round.h"

namespace kiln {

void MappingBlocked::arrive() { ++context().faults; }

Transition MappingBlocked::execute() {
  const MappingContext& c = context();
  display(why_);
  if (toSeconds(timeInState()) < c.rest_s) return stay();
  if (c.faults <= c.max_faults) return transit<MappingRound>().because("trying once more");
  return transit<MappingGivenUp>().because(why_);
}

}  // namespace kiln
