#include "robot/missions/fire/states/protective_stop.h"

#include <fmt/format.h>

#include "common/model/status.h"
#include "robot/missions/fire/states/arm_search.h"
#include "robot/missions/fire/states/drive_to_location.h"
#include "robot/missions/fire/states/next_location.h"
#include "robot/missions/fire/states/safe_stop.h"

namespace kiln {

void ProtectiveStop::enter() {
  FireContext& c = context();
  c.haltAll(now());
  c.aim.reset();
}

void ProtectiveStop::arrive() {
  FireContext& c = context();
  if (c.hasPlace()) ++c.place().arm_faults;
}

Transition ProtectiveStop::execute() {
  FireContext& c = context();
  const std::optional<ArmState> arm = c.devices.arm_device.state();
  const bool released =
      guard("Arm released by the operator", armIsReleased(c),
            arm ? std::string(toString(arm->safety)) : std::string("no arm state"),
            arm ? toSeconds(now() - arm->stamp) : -1.0);
  if (c.elapsedS(now()) >= c.config.clock.limit_s)
    return transit<SafeStop>().because("the mission clock ran out before the arm was released");
  if (!released) {
    released_.reset();
    display("look at the arm, then release the protective stop");
    return stay();
  }
  if (!released_) released_ = now();
  display("released; going on");
  return toSeconds(now() - *released_) >= c.config.faults.release_rest_s ? goOn() : stay();
}

Transition ProtectiveStop::goOn() {
  FireContext& c = context();
  if (!c.hasPlace() || c.place().visited || !c.belief.inside)
    return transit<NextLocation>().because("released");
  if (c.place().arm_faults > c.config.faults.max_arm_faults) {
    c.closePlace("protective stop");
    return transit<NextLocation>().because(fmt::format("released; {} is given up", c.place().name));
  }
  if (c.atWorkPose()) return transit<ArmSearch>().because("released; searching anew");
  return transit<DriveToLocation>().because("released; driving on");
}

}  // namespace kiln
