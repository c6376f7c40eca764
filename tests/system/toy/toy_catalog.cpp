// In place of robot/missions/catalog.cpp: a robot that knows the toy beside the fire.
#include "robot/missions/catalog.h"
#include "robot/missions/fire/make_fire.h"
#include "tests/system/toy/toy_mission.h"

namespace kiln {

const std::vector<MissionKind>& missionKinds() {
  static const std::vector<MissionKind> kKinds{toyMissionKind(), fireMissionKind()};
  return kKinds;
}

}  // namespace kiln
