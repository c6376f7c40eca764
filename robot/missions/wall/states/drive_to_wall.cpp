#include "robot/missions/wall/states/drive_to_wall.h"

#include "robot/missions/wall/states/drive_to_marker.h"
#include "robot/missions/wall/states/locate_wall.h"
#include "robot/missions/wall/states/take_out_brick.h"
#include "robot/missions/wall/states/wall_built.h"
#include "robot/missions/wall/states/wall_drive_blocked.h"

namespace kiln {

void DriveToWall::enter() {
  WallContext& c = context();
  if (!c.isBuilt() && c.belief.wall) c.drive.start({c.buildingPose()}, now());
}

Transition DriveToWall::execute() {
  WallContext& c = context();
  if (c.isBuilt()) return transit<WallBuilt>().because("every brick is set");
  if (!c.belief.wall) return transit<DriveToMarker>().because("the marker was not found yet");
  const SkillStatus drive = c.drive.poll(now());
  guard("Arm stowed", c.drive.stowed());
  display("to the wall: " + drive.text);
  if (drive.phase == SkillPhase::Failed)
    return transit<WallDriveBlocked>(drive.text).because(drive.text);
  if (drive.phase != SkillPhase::Done) return stay();
  c.belief.drive_faults = 0;
  if (c.belief.built.empty()) return transit<TakeOutBrick>().because("before the marker");
  return transit<LocateWall>().because("before the wall");
}

}  // namespace kiln
