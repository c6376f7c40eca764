#include "robot/missions/mapping/states/mapping_round.h"

#include <algorithm>
#include <cmath>

#include "robot/missions/common/route.h"
#include "robot/missions/mapping/states/mapping_blocked.h"
#include "robot/missions/mapping/states/mapping_done.h"

namespace kiln {
namespace {

constexpr double kPassed_m = 0.7;  // a way-point nearer than this lies behind

std::vector<Pose2> mappingPath(const ArenaMap& arena) {
  std::vector<Pose2> path;
  for (const GroundPoseConfig& way_point : arena.mapping_path) path.push_back(way_point.pose());
  return path;
}

}  // namespace

void MappingRound::enter() {
  MappingContext& c = context();
  const std::vector<Pose2> path = mappingPath(c.arena);
  // A restarted program does not know how far it was: on from the nearest piece of the path.
  if (c.passed == 0)
    c.passed = path.size() - remaining(c.arena.start.pose(), path, c.pose()).size();
  c.passed = std::min(c.passed, path.size());
  c.drive.start({path.begin() + static_cast<std::ptrdiff_t>(c.passed), path.end()}, now());
}

Transition MappingRound::execute() {
  MappingContext& c = context();
  const SkillStatus drive = c.drive.poll(now());
  const Pose2 here = c.pose();
  while (c.passed + 1 < c.arena.mapping_path.size()) {
    const Pose2 next = c.arena.mapping_path[c.passed].pose();
    if (std::hypot(next.x_m - here.x_m, next.y_m - here.y_m) > kPassed_m) break;
    ++c.passed;
  }
  guard("Arm stowed", c.drive.stowed());
  display(drive.text);
  if (drive.phase == SkillPhase::Done) return transit<MappingDone>().because("back at the start");
  if (drive.phase == SkillPhase::Failed)
    return transit<MappingBlocked>(drive.text).because(drive.text);
  return stay();
}

}  // namespace kiln
