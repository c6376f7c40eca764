#include "robot/missions/fire/fire_machine.h"

#include "robot/fsm/machine_of.h"
#include "robot/missions/fire/states/aim_hose.h"
#include "robot/missions/fire/states/arm_blocked.h"
#include "robot/missions/fire/states/arm_search.h"
#include "robot/missions/fire/states/check_place.h"
#include "robot/missions/fire/states/drive_blocked.h"
#include "robot/missions/fire/states/drive_to_location.h"
#include "robot/missions/fire/states/enter_building.h"
#include "robot/missions/fire/states/finished.h"
#include "robot/missions/fire/states/heat_found.h"
#include "robot/missions/fire/states/lost_target.h"
#include "robot/missions/fire/states/next_location.h"
#include "robot/missions/fire/states/nothing_found.h"
#include "robot/missions/fire/states/park_arm.h"
#include "robot/missions/fire/states/place_refused.h"
#include "robot/missions/fire/states/protective_stop.h"
#include "robot/missions/fire/states/pump_fault.h"
#include "robot/missions/fire/states/safe_stop.h"
#include "robot/missions/fire/states/spray_pattern.h"
#include "robot/missions/fire/states/spray_steady.h"
#include "robot/missions/fire/states/start_pump.h"
#include "robot/missions/fire/states/stop_pump.h"
#include "robot/missions/fire/states/time_nearly_over.h"

namespace kiln {

using FireMachine =
    MachineOf<FireContext, EnterBuilding,  //
              NextLocation, DriveToLocation, CheckPlace, ArmSearch, HeatFound, ParkArm,
              Finished,                                                 // search fire
              AimHose, StartPump, SpraySteady, SprayPattern, StopPump,  // extinguish
              LostTarget, PumpFault, ArmBlocked, DriveBlocked, ProtectiveStop, TimeNearlyOver,
              PlaceRefused, NothingFound, SafeStop>;  // faults

std::unique_ptr<Machine> makeFireMachine(FireContext& context, const std::string& mission_uuid) {
  MachineCore::Options options;
  options.mission = "fire";
  options.mission_uuid = mission_uuid;
  return std::make_unique<FireMachine>(std::move(options), context.devices.clock, context);
}

}  // namespace kiln
