#include "robot/missions/catalog.h"

#include "robot/missions/fire/make_fire.h"
#include "robot/missions/mapping/mapping_mission.h"
#include "robot/missions/wall/wall_mission.h"

namespace kiln {

const std::vector<MissionKind>& missionKinds() {
  static const std::vector<MissionKind> kKinds{fireMissionKind(), mappingMissionKind(),
                                               wallMissionKind()};
  return kKinds;
}

}  // namespace kiln
