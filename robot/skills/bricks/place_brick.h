#pragma once

#include <optional>
#include <vector>

#include "robot/skills/bricks/brick_handling.h"

namespace kiln {

/// Where a held brick is to lie, and what stands around.
struct PlaceRequest {
  HeldBrick brick;
  Eigen::Isometry3d X_base_slot = Eigen::Isometry3d::Identity();  ///< of the brick that lies there
  std::vector<OrientedBox> around;  ///< in base: bricks, storage; not the held brick
  /// Level unit vector in base towards the neighbour that it is set against; nullopt: there is none.
  std::optional<Eigen::Vector3d> towards;
  /// Poses of the brick on its way into a bin: before it, which is reached freely, then on straight
  /// lines at its door, in its mouth and inside; from the last one it is lowered. Empty: from
  /// straight above.
  std::vector<Eigen::Isometry3d> way_base_brick;
};

/// How a brick was let go.
struct Placement {
  Eigen::Isometry3d X_base_flange = Eigen::Isometry3d::Identity();  ///< measured, at the release
  Eigen::Isometry3d X_base_brick = Eigen::Isometry3d::Identity();   ///< as it should lie then
  bool neighbour_felt = false;
};

/// Sets a held brick down by force: carried with its box in the plan to before its slot, force
/// sensor zeroed at rest, lowered until its support is felt; with a neighbour, raised a little, led
/// towards it until it is felt, back by the joint, and lowered again. It is never pushed: both
/// forces are far below the 20 N that the magnets bear sideways. Then magnets off and straight back
/// along the plate's normal, and a look whether it has let go. Failure codes: no_contact (no
/// support where the slot is), contact (something else was met, above the slot), not_released,
/// dropped, unreachable, in_collision, obstacle, protective_stop (the magnets stay on, nothing is
/// tried again), tracking, stopped, timeout. Confined to the mission thread.
class PlaceBrick {
 public:
  struct Config {
    /// Carried to so far above the slot, and so far from the neighbour: with the clearance of free
    /// motion to it.
    double above_m = 0.08, apart_m = 0.045;
    /// Through the mouth of a bin, then inside it; and what counts as met there.
    double enter_mps = 0.01, inside_mps = 0.03, enter_n = 10.0;
    double near_m = 0.015;   ///< lowered slowly from so far above it
    double aside_m = 0.02;   ///< and there so far from the neighbour
    double beyond_m = 0.02;  ///< led so far below the slot
    double early_m = 0.02;   ///< felt higher above the slot than this, it is no support
    double lower_mps = 0.01;
    double support_n = 6.0;  ///< that counts as felt; a long brick tips off the face under more
    double raise_m = 0.004;  ///< off its support while it is led sideways
    double side_mps = 0.006;
    double side_n = 4.5;        ///< that counts as felt; 6 N shift a red brick
    double side_past_m = 0.02;  ///< led so far beyond the slot, if nothing is felt
    double joint_m = 0.003;     ///< back from what was felt, kPlannedJoint_m
    double release_s = 0.3;     ///< after the magnets are off
    double leave_m = 0.12;
    double leave_mps = 0.06;
    double stuck_m = 0.015;  ///< so far away the switch must be open
    double timeout_s = 120.0;
    HandlingConfig handling;
    void visit(ConfigArchive& a);
  };
  PlaceBrick(Config config, HandlingParts parts);
  /// @pre the brick hangs on the face and the arm was told of it (PickBrick).
  void start(PlaceRequest request, Stamp now);
  [[nodiscard]] SkillStatus poll(Stamp now);
  void cancel();  ///< the arm holds; magnets keep their state
  /// From the release on; nullopt before.
  [[nodiscard]] const std::optional<Placement>& placement() const { return placement_; }
  /// It stays where it was let go, though the face may not have come away from it freely.
  [[nodiscard]] bool hasLetGo() const {
    return placement_ && base_.status.failure_code != "not_released";
  }
  [[nodiscard]] const std::optional<BrickDrop>& drop() const { return base_.drop; }

 private:
  enum class Stage {
    Carrying,
    Entering,
    Zeroing,
    Lowering,
    Raising,
    Nearing,
    BackingOff,
    SettingDown,
    Releasing,
    Leaving
  };
  void enter(Stage stage, std::string text, Stamp now);
  [[nodiscard]] ArmMoveTerms carryTerms(bool half_turn) const;
  void carry(Stamp now);
  void line(Stage stage, std::string text, const Eigen::Isometry3d& X_base_brick, double speed_mps,
            double guard_n, Stamp now);
  [[nodiscard]] bool atTheDoor() const;
  void enterNext(double speed_mps, double guard_n, Stamp now);
  SkillStatus carried(const SkillStatus& motion, Stamp now);
  SkillStatus lowered(const SkillStatus& motion, Stamp now);
  SkillStatus neared(const SkillStatus& motion, Stamp now);
  void release(Stamp now);
  void leave(Stamp now);
  SkillStatus left(const SkillStatus& motion);
  [[nodiscard]] Eigen::Isometry3d X_base_brick() const;  ///< where it hangs now
  [[nodiscard]] std::vector<Eigen::Isometry3d> way() const;
  [[nodiscard]] Eigen::Isometry3d X_base_tool(const Eigen::Isometry3d& X_base_brick) const;

  Config config_;
  BrickHandling base_;
  PlaceRequest request_;
  std::vector<std::string> touchable_;
  Stage stage_ = Stage::Carrying;
  Stamp stage_began_;
  std::vector<bool> turns_;  ///< half turns of the slot that can be reached, nearest first
  std::size_t entered_ = 0;
  Eigen::Isometry3d X_base_release_ = Eigen::Isometry3d::Identity();  ///< of the tool
  bool neighbour_felt_ = false;
  std::optional<Placement> placement_;
};

}  // namespace kiln
