// In place of robot/missions/catalog.cpp: a robot that knows the toy alone.
#include "robot/missions/catalog.h"
#include "tests/system/toy/toy_mission.h"

namespace kiln {

const std::vector<MissionKind>& missionKinds() {
  static const std::vector<MissionKind> kKinds{toyMissionKind()};
  return kKinds;
}

}  // namespace kiln
