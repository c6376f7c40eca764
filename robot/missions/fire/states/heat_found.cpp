#include "robot/missions/fire/states/heat_found.h"

#include <fmt/format.h>

#include "robot/missions/fire/states/aim_hose.h"
#include "robot/missions/fire/states/arm_search.h"
#include "robot/missions/fire/states/next_location.h"

namespace kiln {

Transition HeatFound::execute() {
  FireContext& c = context();
  FirePlace& place = c.place();
  const std::optional<FireEstimate> estimate = c.heat.estimate();
  const double off_m = estimate ? (estimate->p_map - place.p_plate_map).norm() : 0.0;
  const bool found = guard("Has thermal detection", estimate.has_value(),
                           fmt::format("{} views", estimate ? estimate->views : c.heat.sightings()),
                           c.heat.seenAgeS(now()));
  const bool near =
      found && guard("Near the configured place", off_m <= c.config.search.place_gate_m,
                     fmt::format("{:.2f} m off", off_m));
  if (near) {
    place.estimate = estimate;
    place.estimate->place = place.name;
    place.searches = 0;
    return transit<AimHose>().because(
        fmt::format("{:.0f} K at {:.2f} m", estimate->peak_k, estimate->range_m));
  }
  const std::optional<double> rise_kps = c.warming.rise();
  const bool steady = guard("Temperature is steady", !rise_kps,
                            fmt::format("rises by {:.1f} K/s", rise_kps.value_or(0.0)));
  if (!steady) {
    --place.searches;  // it could not have been found yet
    return transit<ArmSearch>().because("the place is still warming");
  }
  const bool glimpsed = c.heat.sightings() > 0 || c.heat.looks() == 0;
  if (glimpsed && place.searches < c.config.search.max_searches)
    return transit<ArmSearch>().because(c.heat.looks() == 0 ? "no usable thermal image"
                                                            : "glimpsed, not located");
  c.closePlace(found ? fmt::format("heat source {:.2f} m off its place", off_m) : "no heat source");
  return transit<NextLocation>().because(place.outcome);
}

}  // namespace kiln
