#pragma once

#include <string>

#include "robot/missions/common/mission_parts.h"
#include "robot/missions/common/stowed_drive.h"
#include "robot/missions/wall/wall_belief.h"
#include "robot/missions/wall/wall_config.h"
#include "robot/missions/wall/wall_plan.h"
#include "robot/scene/wall_site_map.h"

namespace kiln {

/// What the states of the wall mission share. Confined to the mission thread.
class WallContext {
 public:
  WallContext(const MissionParts& mission_parts, const WallConfig& wall_config,
              const WallSiteMap& site_map, const WallPlan& wall_plan);

  const MissionParts parts;
  const WallConfig config;
  const WallSiteMap site;  ///< as configured
  const WallPlan plan;
  WallBelief belief;
  StowedDrive drive;
  SweepLook look;
  PileTask pile;
  PoolQuestion<Result<BrickSight>> bricks;
  MarkerTask marker;

  /// Where they are believed to be: as found, else as configured.
  [[nodiscard]] Pose2 X_map_pile() const;
  [[nodiscard]] Pose2 X_map_wall() const;
  /// Where the base stands for the given look, the first one before the middle.
  [[nodiscard]] Pose2 pileLookPose(int look) const;
  [[nodiscard]] Pose2 markerLookPose(int look) const;
  /// Asks what a sweep shows of the bricks that are still in the pile. @pre the pile was found
  void askForBricks(std::shared_ptr<const BrickSweep> sweep);
  /// The bricks that are still in the pile, as they are believed to stand from here.
  [[nodiscard]] ExpectedBricks expectedBricks() const;
  /// Something of the site was found: what everybody plans with follows.
  void siteMoved();
  /// Arm and base come to rest, nobody looks.
  void halt();
};

}  // namespace kiln
