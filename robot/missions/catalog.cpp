#include "robot/missions/catalog.h"

#include "robot/missions/fire/make_fire.h"
#include "robot/missions/mapping/mapping_mission.h"

namespace kiln {

const std::vector<MissionKind>& missionKinds() {
  static const std::vector<MissionKind> kKinds{fireMissionKind(), mappingMissionKind()};
  return kKinds;
}

}  // namespace kiln
