#include "robot/missions/fire/states/next_location.h"

#include <fmt/format.h>

#include "robot/missions/fire/states/drive_to_location.h"
#include "robot/missions/fire/states/enter_building.h"
#include "robot/missions/fire/states/park_arm.h"

namespace kiln {
namespace {

/// What was tried in the round before does not count against the next.
void beginRound(FireBelief& belief) {
  ++belief.search_round;
  for (FirePlace& place : belief.places) {
    place.visited = place.extinguished;
    place.searches = place.losses = place.pump_faults = place.arm_faults = place.drive_faults = 0;
  }
}

}  // namespace

Transition NextLocation::execute() {
  FireContext& c = context();
  FireBelief& belief = c.belief;
  if (!guard("Inside the building", belief.inside))
    return transit<EnterBuilding>().because("still outside");
  if (belief.nextPlace() < 0 && !belief.anyExtinguished() &&
      belief.search_round < c.config.search.max_rounds)
    beginRound(belief);
  const int next = belief.nextPlace();
  belief.current_place = next;
  c.aim.reset();
  if (guard("Has next location", next >= 0))
    return transit<DriveToLocation>().because(
        fmt::format("{}, round {}", c.place().name, belief.search_round));
  return transit<ParkArm>().because("all places were visited");
}

}  // namespace kiln
