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
  /// Of a robot with gripper and storage.
  struct Hands {
    PickBrick pick;
    PlaceBrick store;
    MoveStorage travel;
  };
  std::optional<Hands> hands;
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

  /// What is gathered from the pile and carried to the wall.
  [[nodiscard]] const WallLoad& load() const { return plan.loads.front(); }
  /// How many bricks are stored at all.
  [[nodiscard]] std::size_t toStore() const;
  [[nodiscard]] bool loaded() const { return belief.stored >= toStore(); }
  /// The brick of the pile to take next: of the kind that the plan stores next, trusted, with none
  /// upon it, the nearest one. nullopt: there is none.
  [[nodiscard]] std::optional<std::size_t> nextBrick() const;
  /// Where the base stands to look at a brick of the pile once more, and to take it.
  [[nodiscard]] Pose2 stackLookPose(std::size_t pile_brick) const;
  [[nodiscard]] Pose2 takingPose(std::size_t pile_brick) const;
  [[nodiscard]] bool standsAt(const Pose2& X_map_stand) const;
  /// As the skills know it, in base.
  [[nodiscard]] KnownBrick knownBrick(std::size_t pile_brick) const;
  /// In base: the storage with what stands in it; and the bricks that are still in the pile.
  [[nodiscard]] std::vector<OrientedBox> storageNow() const;
  [[nodiscard]] std::vector<OrientedBox> storageAt(const StoragePosture& posture) const;
  [[nodiscard]] std::vector<OrientedBox> aroundHands() const;
  /// The seat of what is stored next, with the compartments standing so; where the brick comes from
  /// on its way there is `out_m` before it and `up_m` above its floor.
  [[nodiscard]] Eigen::Isometry3d X_base_seat(const StoragePosture& posture, double out_m = 0.0,
                                              double up_m = 0.0) const;
  /// Can the arm bring the held brick there? Error: what hinders it. @pre a brick is held
  [[nodiscard]] Result<void> checkSeat(const StoragePosture& posture) const;
  /// Until the next halt() each brick is an obstacle by itself, told with the arm's motions, and not
  /// their stacks: the base must rest.
  void handleBricks();

  /// Something of the site was found: what everybody plans with follows.
  void siteMoved();
  /// Arm, base and storage come to rest, nobody looks; what stands around is as it is believed.
  void halt();
};

}  // namespace kiln
