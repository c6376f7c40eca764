#include "robot/missions/wall/states/arm_stopped.h"

#include "common/model/status.h"
#include "robot/missions/wall/states/drive_to_marker.h"
#include "robot/missions/wall/states/drive_to_pile.h"
#include "robot/missions/wall/states/drive_to_wall.h"
#include "robot/missions/wall/states/locate_bricks.h"
#include "robot/missions/wall/states/set_brick.h"
#include "robot/missions/wall/states/store_brick.h"
#include "robot/missions/wall/states/wall_given_up.h"

namespace kiln {

Transition ArmStopped::execute() {
  const WallContext& c = context();
  const std::optional<ArmState> arm = c.parts.arm_device.state();
  const bool released =
      guard("Arm released by the operator", armIsReleased(c),
            arm ? std::string(toString(arm->safety)) : std::string("no arm state"),
            arm ? toSeconds(now() - arm->stamp) : -1.0);
  if (c.parts.belief.elapsedS(now()) >= c.config.limit_s)
    return transit<WallGivenUp>().because("the mission clock ran out before the arm was released");
  if (!released) {
    display("look at the arm, then release the protective stop");
    return stay();
  }
  if (c.belief.held) {
    const char* why = "released; a brick hangs on the gripper";
    if (c.belief.unloading()) return transit<SetBrick>().because(why);
    return transit<StoreBrick>().because(why);
  }
  if (!c.belief.pile) return transit<DriveToPile>().because("released; to the pile");
  if (c.hands && !c.loaded()) return transit<LocateBricks>().because("released; to the bricks");
  if (c.belief.wall && c.builds()) return transit<DriveToWall>().because("released; to the wall");
  return transit<DriveToMarker>().because("released; to the marker");
}

}  // namespace kiln
