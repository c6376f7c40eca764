#include "robot/missions/fire/states/drive_blocked.h"

#include "robot/missions/fire/states/drive_to_location.h"
#include "robot/missions/fire/states/enter_building.h"
#include "robot/missions/fire/states/next_location.h"
#include "robot/missions/fire/states/safe_stop.h"

namespace kiln {

void DriveBlocked::enter() { context().devices.base.cancel(); }

void DriveBlocked::arrive() {
  FireContext& c = context();
  if (c.belief.inside && c.hasPlace())
    ++c.place().drive_faults;
  else
    ++c.belief.entry_faults;
}

Transition DriveBlocked::execute() {
  FireContext& c = context();
  display(why_);
  if (toSeconds(timeInState()) < c.config.drive.rest_s) return stay();
  if (!c.belief.inside || !c.hasPlace()) return outside();
  if (c.place().drive_faults <= c.config.drive.max_faults)
    return transit<DriveToLocation>().because("trying once more");
  c.closePlace("cannot be reached: " + why_);
  return transit<NextLocation>().because(c.place().outcome);
}

Transition DriveBlocked::outside() {
  FireContext& c = context();
  if (c.belief.entry_faults <= c.config.drive.max_faults)
    return transit<EnterBuilding>().because("trying once more");
  return transit<SafeStop>().because("the building cannot be entered: " + why_);
}

}  // namespace kiln
