#include "robot/missions/fire/states/lost_target.h"

#include <fmt/format.h>

#include "robot/missions/fire/states/arm_search.h"
#include "robot/missions/fire/states/next_location.h"

namespace kiln {

void LostTarget::arrive() { ++context().place().losses; }

void LostTarget::enter() {
  FireContext& c = context();
  c.pumpsOff(now());
  c.place().estimate.reset();  // it has proven wrong
  c.aim.reset();
}

Transition LostTarget::execute() {
  FireContext& c = context();
  const int losses = c.place().losses;
  const int allowed = c.config.aim.max_losses;
  if (guard("Search once more", losses <= allowed,
            fmt::format("lost {} times, {} allowed", losses, allowed)))
    return transit<ArmSearch>().because(fmt::format("lost {} times", losses));
  c.closePlace("heat source lost while aiming");
  return transit<NextLocation>().because(c.place().outcome);
}

}  // namespace kiln
