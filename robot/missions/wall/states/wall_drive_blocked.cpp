#include "robot/missions/wall/states/wall_drive_blocked.h"

#include "robot/missions/wall/states/drive_to_marker.h"
#include "robot/missions/wall/states/drive_to_pile.h"
#include "robot/missions/wall/states/drive_to_wall.h"
#include "robot/missions/wall/states/locate_bricks.h"
#include "robot/missions/wall/states/wall_given_up.h"

namespace kiln {

void WallDriveBlocked::arrive() {
  WallBelief& belief = context().belief;
  ++belief.drive_faults;
  if (!belief.pile)
    ++belief.pile_looks;
  else if (context().loaded() && !belief.wall)
    ++belief.marker_looks;
}

Transition WallDriveBlocked::execute() {
  const WallContext& c = context();
  display(why_);
  if (toSeconds(timeInState()) < c.config.rest_s) return stay();
  if (c.belief.drive_faults > c.config.max_drive_faults)
    return transit<WallGivenUp>().because("cannot be reached: " + why_);
  if (!c.belief.pile) return transit<DriveToPile>().because("from another side");
  if (c.hands && !c.loaded()) return transit<LocateBricks>().because("once more from here");
  if (c.belief.wall && c.builds()) return transit<DriveToWall>().because("once more from here");
  return transit<DriveToMarker>().because("from another side");
}

}  // namespace kiln
