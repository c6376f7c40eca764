#include "robot/missions/wall/states/drive_to_marker.h"

#include "robot/missions/wall/states/find_marker.h"
#include "robot/missions/wall/states/wall_drive_blocked.h"

namespace kiln {

void DriveToMarker::enter() {
  WallContext& c = context();
  c.drive.start({c.markerLookPose(c.belief.marker_looks)}, now());
}

Transition DriveToMarker::execute() {
  WallContext& c = context();
  const SkillStatus drive = c.drive.poll(now());
  guard("Arm stowed", c.drive.stowed());
  display("to the marker: " + drive.text);
  if (drive.phase == SkillPhase::Failed)
    return transit<WallDriveBlocked>(drive.text).because(drive.text);
  if (drive.phase != SkillPhase::Done) return stay();
  c.belief.drive_faults = 0;
  return transit<FindMarker>().because("before the marker");
}

}  // namespace kiln
