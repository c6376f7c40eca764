#include "robot/missions/mapping/mapping_machine.h"

#include "robot/fsm/machine_of.h"
#include "robot/missions/mapping/states/mapping_blocked.h"
#include "robot/missions/mapping/states/mapping_done.h"
#include "robot/missions/mapping/states/mapping_given_up.h"
#include "robot/missions/mapping/states/mapping_round.h"

namespace kiln {

using MappingMachine =
    MachineOf<MappingContext, MappingRound, MappingBlocked, MappingDone, MappingGivenUp>;

std::unique_ptr<Machine> makeMappingMachine(MappingContext& context,
                                            const std::string& mission_uuid) {
  MachineCore::Options options;
  options.mission = "mapping";
  options.mission_uuid = mission_uuid;
  return std::make_unique<MappingMachine>(std::move(options), context.clock, context);
}

}  // namespace kiln
