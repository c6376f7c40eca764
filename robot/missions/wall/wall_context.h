#pragma once

#include <string>

#include "robot/missions/common/mission_parts.h"
#include "robot/missions/common/stowed_drive.h"
#include "robot/missions/wall/brick_look.h"
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
  BrickLook brick_look;
  std::optional<Pose2> pile_looked_from;  ///< X_map_base of the newest look that showed bricks
  /// Of a robot with gripper and storage.
  struct Hands {
    PickBrick pick;
    PlaceBrick store;
    PickBrick take_out;
    PlaceBrick set;
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
  /// The bricks that are still in the pile, as they are believed to stand from here.
  [[nodiscard]] ExpectedBricks expectedBricks() const;

  /// What is gathered from the pile and carried to the wall.
  [[nodiscard]] const WallLoad& load() const { return plan.loads.front(); }
  /// How many bricks are stored at all.
  [[nodiscard]] std::size_t toStore() const;
  [[nodiscard]] bool loaded() const { return belief.stored >= toStore(); }
  /// Bricks are missing in the pile, by this mission.
  [[nodiscard]] bool anyTaken() const;
  /// What is stored is the whole wall, so that it is built; else it stays in the storage.
  [[nodiscard]] bool builds() const {
    return plan.loads.size() == 1 && toStore() > 0 && toStore() == load().storage.load.size();
  }
  [[nodiscard]] bool isBuilt() const { return belief.built.size() >= load().slots.size(); }
  /// The step that set, or will set, the held brick into its bin. @pre a brick is held
  [[nodiscard]] const StorageStep& heldStep() const;
  /// The step that takes out what is built next. @pre !isBuilt()
  [[nodiscard]] const StorageStep& nextOut() const {
    return load().storage.unload[belief.built.size()];
  }
  /// A brick of the load's sequence stands in its bin.
  [[nodiscard]] bool inStorage(std::size_t brick) const;
  /// Where the base stands to set the next brick, and where that is to lie. @pre !isBuilt()
  [[nodiscard]] Pose2 buildingPose() const;
  [[nodiscard]] Eigen::Isometry3d X_wall_slot() const;
  /// Unit vector in the wall frame to the neighbour against which it is set; nullopt: there is none.
  [[nodiscard]] std::optional<Eigen::Vector3d> towardsNeighbour() const;
  /// What was set, as it is believed to stand from here.
  [[nodiscard]] ExpectedBricks expectedWall() const;
  /// The brick of the pile to take next: of the kind that the plan stores next, trusted, with none
  /// upon it, the nearest one. nullopt: there is none.
  [[nodiscard]] std::optional<std::size_t> nextBrick() const;
  /// Where the base stands to look at a brick of the pile once more, and to take it.
  [[nodiscard]] Pose2 stackLookPose(std::size_t pile_brick) const;
  [[nodiscard]] Pose2 takingPose(std::size_t pile_brick) const;
  [[nodiscard]] bool standsAt(const Pose2& X_map_stand) const;
  [[nodiscard]] bool stoodSincePileLook() const;
  /// As the skills know it, in base.
  [[nodiscard]] KnownBrick knownBrick(std::size_t pile_brick) const;
  /// In base: the storage with what stands in it; and the bricks that are still in the pile.
  [[nodiscard]] std::vector<OrientedBox> storageNow() const;
  [[nodiscard]] std::vector<OrientedBox> storageAt(const StoragePosture& posture) const;
  /// In base: what stands in the storage, and what hangs on the gripper.
  [[nodiscard]] std::vector<KnownBrick> carriedBricks() const;
  [[nodiscard]] std::vector<OrientedBox> aroundHands() const;
  /// The seat of a step's brick with the compartments standing so, or so far before it.
  [[nodiscard]] Eigen::Isometry3d X_base_seat(const StorageStep& step,
                                              const StoragePosture& posture,
                                              double out_m = 0.0) const;
  /// The way to there, the seat itself left out.
  [[nodiscard]] std::vector<Eigen::Isometry3d> seatWay(const StorageStep& step,
                                                       const StoragePosture& posture) const;
  /// Magnets are on and the contact switch is closed: whatever it is, it hangs.
  [[nodiscard]] bool somethingHangs() const;
  /// Until the next halt() each brick is an obstacle by itself, told with the arm's motions, and not
  /// their stacks: the base must rest.
  void handleBricks();

  /// Something of the site was found: what everybody plans with follows.
  void siteMoved();
  /// Arm, base and storage come to rest, nobody looks; what stands around is as it is believed.
  void halt();

 private:
  /// @pre hands
  [[nodiscard]] StoragePosture postureNow() const;
  [[nodiscard]] std::vector<StoredBrick> storedBricks() const;

  const StorageRoom room_;
};

}  // namespace kiln
