#include "robot/missions/fire/states/next_location.h"

#include <fmt/format.h>

#include "robot/missions/fire/states/drive_to_location.h"
#include "robot/missions/fire/states/enter_building.h"
#include "robot/missions/fire/states/park_arm.h"

namespace kiln {
namespace {

/// What was tried in the round before does not count against the next.
void beginRound(WorldState& world) {
  ++world.search_round;
  for (FirePlace& place : world.places) {
    place.visited = place.extinguished;
    place.searches = place.losses = place.pump_faults = place.arm_faults = place.drive_faults = 0;
  }
}

}  // namespace

Transition NextLocation::execute() {
  FireContext& c = context();
  WorldState& world = c.world();
  if (!guard("Inside the building", world.inside))
    return transit<EnterBuilding>().because("still outside");
  if (world.nextPlace() < 0 && !world.anyExtinguished() &&
      world.search_round < c.config.search.max_rounds)
    beginRound(world);
  const int next = world.nextPlace();
  world.current_place = next;
  c.aim.reset();
  if (guard("Has next location", next >= 0))
    return transit<DriveToLocation>().because(
        fmt::format("{}, round {}", c.place().name, world.search_round));
  return transit<ParkArm>().because("all places were visited");
}

}  // namespace kiln
