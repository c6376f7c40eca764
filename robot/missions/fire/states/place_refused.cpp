#include "robot/missions/fire/states/place_refused.h"

#include <fmt/format.h>

#include "robot/missions/fire/states/arm_search.h"
#include "robot/missions/fire/states/check_place.h"
#include "robot/missions/fire/states/next_location.h"

namespace kiln {

void PlaceRefused::enter() {
  context().haltMotion();
  nudges_ = context().place().nudges;
}

Transition PlaceRefused::execute() {
  FireContext& c = context();
  const std::string why =
      c.place_check ? c.place_check->reason : c.place().name + " was not seen by the LiDAR";
  const bool nudged = guard("Place nudged by the operator", c.place().nudges != nudges_, why);
  const double left_s = c.config.check.wait_s - toSeconds(timeInState());
  display(fmt::format("{}; going on without it in {:.0f} s", why, std::max(0.0, left_s)));
  if (nudged) return transit<CheckPlace>().because("the place was nudged");
  if (left_s > 0.0) return stay();
  c.closePlace("not where it was configured");
  return transit<NextLocation>().because(why);
}

}  // namespace kiln
