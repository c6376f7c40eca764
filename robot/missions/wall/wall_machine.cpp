#include "robot/missions/wall/wall_machine.h"

#include "robot/fsm/machine_of.h"
#include "robot/missions/wall/states/approach_stack.h"
#include "robot/missions/wall/states/arm_stopped.h"
#include "robot/missions/wall/states/drive_to_marker.h"
#include "robot/missions/wall/states/drive_to_pile.h"
#include "robot/missions/wall/states/drive_to_stack.h"
#include "robot/missions/wall/states/drive_to_wall.h"
#include "robot/missions/wall/states/find_marker.h"
#include "robot/missions/wall/states/find_pile.h"
#include "robot/missions/wall/states/locate_bricks.h"
#include "robot/missions/wall/states/locate_wall.h"
#include "robot/missions/wall/states/set_brick.h"
#include "robot/missions/wall/states/store_brick.h"
#include "robot/missions/wall/states/take_brick.h"
#include "robot/missions/wall/states/take_out_brick.h"
#include "robot/missions/wall/states/wall_built.h"
#include "robot/missions/wall/states/wall_drive_blocked.h"
#include "robot/missions/wall/states/wall_given_up.h"
#include "robot/missions/wall/states/wall_surveyed.h"

namespace kiln {

using WallMachine = MachineOf<WallContext, DriveToPile, FindPile, LocateBricks, DriveToStack,
                              ApproachStack, TakeBrick, StoreBrick, DriveToMarker, FindMarker,
                              DriveToWall, LocateWall, TakeOutBrick, SetBrick, WallBuilt,
                              WallSurveyed, WallDriveBlocked, ArmStopped, WallGivenUp>;

std::unique_ptr<Machine> makeWallMachine(WallContext& context, const std::string& mission_uuid) {
  MachineCore::Options options;
  options.mission = "wall";
  options.mission_uuid = mission_uuid;
  return std::make_unique<WallMachine>(std::move(options), context.parts.clock, context);
}

}  // namespace kiln
