#include "robot/missions/fire/states/arm_search.h"

#include <fmt/format.h>

#include "robot/missions/fire/states/arm_blocked.h"
#include "robot/missions/fire/states/heat_found.h"

namespace kiln {

void ArmSearch::arrive() { ++context().place().searches; }

void ArmSearch::enter() {
  FireContext& c = context();
  c.aim.reset();
  c.heat.begin(c.placeNormal());
  c.warming.begin(c.place().p_plate_map);
  c.look.start(c.X_map_base(), c.place().p_plate_map, c.placeNormal(), now());
}

Transition ArmSearch::execute() {
  FireContext& c = context();
  const SkillStatus look = c.look.poll(now());
  const double image_age_s = c.heat.imageAgeS(now());
  guard("Thermal images arrive",
        image_age_s >= 0.0 && image_age_s < c.config.search.image_timeout_s, c.heat.lastRefusal(),
        image_age_s);
  guard("Heat source in view", c.heat.sightings() > 0,
        fmt::format("{} of {} images", c.heat.sightings(), c.heat.looks()), c.heat.seenAgeS(now()));
  display(fmt::format("{}: {} {:.0f} %", c.place().name, look.text, 100.0 * look.progress));
  if (look.phase == SkillPhase::Failed)
    return transit<ArmBlocked>(look.text, ArmBlocked::While::Extended).because(look.text);
  if (look.phase == SkillPhase::Done)
    return transit<HeatFound>().because(
        fmt::format("heat in {} of {} images", c.heat.sightings(), c.heat.looks()));
  return stay();
}

void ArmSearch::leave() {
  context().heat.stopListening();
  context().haltMotion();
}

}  // namespace kiln
