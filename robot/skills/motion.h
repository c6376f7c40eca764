#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/core/error.h"
#include "common/core/stamp.h"
#include "common/geom/pose.h"
#include "robot/planning/arm_motion/arm_collision.h"
#include "robot/skills/skill.h"

namespace kiln {

/// The base as missions see it: drives along way-points in `map` and stops at the last one.
/// Implemented by DriveTo. Confined to the mission thread.
class BaseMotion {
 public:
  virtual ~BaseMotion() = default;
  virtual void start(std::vector<Pose2> waypoints_map, Stamp now) = 0;
  [[nodiscard]] virtual SkillStatus poll(Stamp now) = 0;
  virtual void cancel() = 0;  ///< base ramps to rest
};

/// Straight lines that the arm is to follow once it is at its goal.
struct LineAhead {
  std::vector<Eigen::Isometry3d> X_base_flange;
  std::vector<std::string> touchable;  ///< of the boxes around: may be touched on them
  double clearance_m = 0.0;            ///< kept on them
};

/// What differs from the skill's configuration in the moves that begin under it.
struct ArmMoveTerms {
  std::optional<double> line_speed_mps, guard_force_n, clearance_m, joint_accel_radps2, speed_scale;
  ArmScene scene;                      ///< what stands around beside the arena
  std::optional<OrientedBox> carried;  ///< a box fixed to the flange, in flange axes
  bool keep_tilt = false;  ///< joint moves turn what is carried about the vertical alone
  bool watch = true;       ///< the live cloud may forbid it
  /// Of the postures at the pose that is asked for only those from which these can be followed.
  std::optional<LineAhead> ahead;
};

/// The arm as missions see it: collision-checked, guarded motion to joint or Cartesian goals.
/// Implemented by MoveArm. Confined to the mission thread.
class ArmMotion {
 public:
  virtual ~ArmMotion() = default;
  /// Of all moves and checks from now on; {}: the usual ones.
  virtual void setTerms(ArmMoveTerms terms) = 0;
  virtual void startJoints(const Vector6d& q_goal, Stamp now) = 0;
  /// Straight in joint space from where the arm rests, so slowly that the motion lasts
  /// `duration_s`, for a sensor that looks around meanwhile. There is no way around: in_collision
  /// where the straight one is not free; and no second try: an interruption ends it (tracking).
  virtual void startTimed(const Vector6d& q_goal, double duration_s, Stamp now) = 0;
  virtual void startPose(const Eigen::Isometry3d& X_base_flange, Stamp now) = 0;
  virtual void startCartesian(std::vector<Eigen::Isometry3d> X_base_flange, bool blend,
                              Stamp now) = 0;
  /// Back to where the arm was that long before the last move ended, by its joints: away from what
  /// it met, where it came from. Done at once after a move that never began.
  virtual void startBack(double seconds, Stamp now) = 0;
  [[nodiscard]] virtual SkillStatus poll(Stamp now) = 0;
  virtual void cancel() = 0;  ///< arm decelerates and holds
  /// Reachable and free of collision now? Error says why not.
  [[nodiscard]] virtual Result<Vector6d> check(const Eigen::Isometry3d& X_base_flange) const = 0;
};

}  // namespace kiln
