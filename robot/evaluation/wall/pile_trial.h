#pragma once

#include <memory>
#include <string>
#include <vector>

#include "robot/evaluation/bricks/brick_trial.h"
#include "robot/evaluation/wall/wall_rig.h"
#include "robot/missions/wall/skills/view_planner.h"
#include "robot/scene/wall_site_map.h"

namespace kiln {

/// What the robot learnt of a pile by its own sensors, from its start on: a first look, the drive to
/// a stand before what it found, the sweeps that were planned there, and the bricks in them.
struct PileLook {
  double found_after_m = 0.0;  ///< from the base to the pile's middle, at the first look
  Pose2 X_start_pile;          ///< by the first look; start: where the base began, by the wheels
  ViewPlan plan;
  std::vector<SweepCloud> clouds;
  BrickTarget target;  ///< as brick perception was asked
  BrickSight sight;
  double plan_s = 0.0;  ///< processor time of the planning of views
};

struct PileLookOptions {
  double stand_m = 3.0;  ///< of the base's middle from the pile's front line
  ViewPlanner::Config views;
};

/// @return the first step's Error that failed, with what it was about.
[[nodiscard]] Result<PileLook> lookAtPile(WallRig& rig, const RobotGeometry& robot, ArenaMap& arena,
                                          WallSiteMap site, const PileLookOptions& options);

}  // namespace kiln
