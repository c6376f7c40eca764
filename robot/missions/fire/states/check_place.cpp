#include "robot/missions/fire/states/check_place.h"

#include "robot/missions/fire/states/arm_search.h"
#include "robot/missions/fire/states/place_refused.h"

namespace kiln {

void CheckPlace::enter() {
  looks_ = 0;
  context().place_check.reset();
  look();
}

void CheckPlace::look() {
  FireContext& c = context();
  ++looks_;
  asked_ = true;
  asked_at_ = now();
  c.devices.place_look.begin(c.place().name, c.placeFront());
}

Transition CheckPlace::execute() {
  FireContext& c = context();
  const FireCheckConfig& config = c.config.check;
  if (!asked_ && now() >= next_look_) look();
  const std::optional<PlaceCheck> seen = asked_ ? c.devices.place_look.answer() : std::nullopt;
  const bool late = asked_ && toSeconds(now() - asked_at_) > config.look_timeout_s;
  if (seen) {
    c.place_check = seen;
    c.place_checks[seen->place] = *seen;
  }
  const bool fits = c.place_check && c.place_check->verdict == PlaceVerdict::Fits;
  guard("Place as configured", fits,
        c.place_check ? c.place_check->reason : "looking at " + c.place().name,
        c.place_check ? toSeconds(now() - c.place_check->stamp) : -1.0);
  display(c.place_check ? c.place_check->reason : "looking at " + c.place().name);
  if (fits) return transit<ArmSearch>().because(c.place_check->reason);
  if (!seen && !late) return stay();
  asked_ = false;
  next_look_ = now() + fromSeconds(config.between_looks_s);
  if (looks_ < config.max_looks) return stay();
  return transit<PlaceRefused>().because(c.place_check ? c.place_check->reason
                                                       : "the live cloud does not answer");
}

}  // namespace kiln
