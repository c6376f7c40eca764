#pragma once

#include <optional>
#include <vector>

#include "robot/skills/bricks/brick_handling.h"

namespace kiln {

/// A brick and all that stands around it.
struct PickRequest {
  KnownBrick brick;                 ///< in base
  std::vector<OrientedBox> around;  ///< in base: other bricks, storage; the brick itself or not
  /// Unit vector in base along which it is lifted; nullopt: along its plate's normal. What stands in
  /// a bin is lifted upwards.
  std::optional<Eigen::Vector3d> lift;
  double out_m = 0.0;  ///< once lifted, led so far along its plate's normal
};

/// Takes a brick by its plate (paper, "Multi Purpose End-effector"): to a place before the plate,
/// force sensor zeroed at rest, straight and guarded along the plate's normal until something is
/// felt, magnets on, contact switch closed, the arm told of the payload, lifted a little, weighed,
/// lifted. What was not met or does not hang is tried again beside, on a spiral. Failure codes:
/// no_contact (nothing felt where the plate should be, or no switch), not_held (felt, but it did
/// not come along), dropped (hung and is gone), unreachable, in_collision, obstacle, protective_stop
/// (the magnets stay as they are, nothing is tried again), tracking, stopped, timeout. Confined to
/// the mission thread.
class PickBrick {
 public:
  struct Config {
    double above_m = 0.045;      ///< the face stands so far before the plate
    double beyond_m = 0.02;      ///< and is led so far beyond where the plate should be
    double approach_mps = 0.01;  ///< until something is felt
    double touch_n = 12.0;       ///< that counts as felt
    double switch_s = 0.6;       ///< for the contact switch to close
    double grip_s = 0.15;        ///< closed for so long before it is lifted
    double check_lift_m = 0.02;  ///< lifted so far to be weighed
    double lift_m = 0.12;        ///< and so far in the end
    double lift_mps = 0.06;
    double weigh_s = 0.3;            ///< at rest
    double weight_tolerance = 0.35;  ///< of the weight, that may be missing or too much
    int max_tries = 5;               ///< with an offset each
    double spiral_m = 0.012;         ///< between neighbours on the spiral
    double timeout_s = 90.0;
    HandlingConfig handling;
    void visit(ConfigArchive& a);
  };
  PickBrick(Config config, HandlingParts parts);
  void start(PickRequest request, Stamp now);
  [[nodiscard]] SkillStatus poll(Stamp now);
  void cancel();  ///< the arm holds; magnets keep their state
  /// What hangs on the face, once it was weighed; nullopt: nothing. X_tool_brick has the offset of
  /// the grasp, as far as the brick lay where it was believed to.
  [[nodiscard]] const std::optional<HeldBrick>& held() const { return held_; }
  [[nodiscard]] const std::optional<BrickDrop>& drop() const { return base_.drop; }
  [[nodiscard]] int tries() const { return try_ + 1; }

 private:
  enum class Stage {
    Above,
    Zeroing,
    Approaching,
    Gripping,
    LiftingABit,
    Weighing,
    Lifting,
    LayingBack,
    Withdrawing
  };
  void enter(Stage stage, std::string text, Stamp now);
  void goAbove(Stamp now);
  void startAbove(Stamp now);
  SkillStatus nextPose(const SkillStatus& motion, Stamp now);
  SkillStatus approached(const SkillStatus& motion, Stamp now);
  SkillStatus grip(Stamp now);
  SkillStatus weigh(Stamp now);
  SkillStatus again(const char* code, std::string text, Stamp now);
  SkillStatus withdrawn(Stamp now);
  [[nodiscard]] Eigen::Isometry3d before(double away_m) const;
  [[nodiscard]] ArmMoveTerms aboveTerms(const Eigen::Isometry3d& X_base_tool) const;
  [[nodiscard]] Eigen::Isometry3d lifted(double by_m) const;
  [[nodiscard]] ArmMoveTerms lineTerms(double speed_mps, double guard_n) const;
  [[nodiscard]] HeldBrick asGripped() const;

  Config config_;
  BrickHandling base_;
  PickRequest request_;
  std::vector<std::string> touchable_;
  Stage stage_ = Stage::Above;
  Stamp stage_began_;
  int try_ = 0;
  std::vector<Eigen::Isometry3d> candidates_;  ///< X_base_tool on the plate, nearest first
  Eigen::Isometry3d X_base_grip_ = Eigen::Isometry3d::Identity();
  std::optional<Stamp> closed_since_;
  double weight_sum_n_ = 0.0;
  int weight_samples_ = 0;
  std::string failed_code_, failed_text_;
  std::optional<HeldBrick> held_;
};

}  // namespace kiln
