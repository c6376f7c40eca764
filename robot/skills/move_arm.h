#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "common/core/clock.h"
#include "common/core/error.h"
#include "robot/control/arm_controller.h"
#include "robot/planning/arm_motion/arm_planner.h"
#include "robot/planning/arm_motion/cartesian_path.h"
#include "robot/scene/arena_map.h"
#include "robot/skills/arm_watch.h"
#include "robot/skills/motion.h"

namespace kiln {

/// Moves the arm to joint or Cartesian goals: inverse kinematics over all UR solutions, limits,
/// self-collision, collision with base, tanks and the known scene, then a jerk-limited joint or
/// straight-line trajectory that is streamed as setpoints at 50 Hz. Guarded by default: stops on
/// unexpected force; a move that begins while something presses stops when it presses harder.
/// Starting a move holds the arm first (which also ends a latched contact stop)
/// and plans from rest. A move that something else than a contact interrupts (a loop that slipped,
/// a state that came late, an arm that lags) is taken up again from where the arm rests, a bounded
/// number of times; of a path only what is left. Failure codes: unreachable, in_collision, obstacle
/// (the live cloud shows something where the arm would pass), contact, protective_stop, tracking,
/// timeout, stopped.
class MoveArm final : public ArmMotion {
 public:
  struct Config {
    double speed_scale = 0.3;  ///< of the joint limits
    double cartesian_speed_mps = 0.25;
    double cartesian_accel_mps2 = 0.5;
    double guard_force_n = 40.0;
    double clearance_m = 0.03;  ///< to base, tanks, scene and itself
    double joint_accel_radps2 = 2.0;
    double jerk_time_s = 0.12;        ///< ramp of the acceleration
    double goal_tolerance_deg = 0.5;  ///< measured joints at the end
    double settle_timeout_s = 2.0;    ///< to come to rest before and after
    int planning_slice = 10;          ///< search iterations in one poll
    int max_resumes = 4;              ///< of one move after interruptions without a contact
    double max_gap_s = 0.25;          ///< between two polls; a longer one interrupts the move
    ArmPlanner::Config planner;
    CartesianPathConfig cartesian;
    ArmWatchConfig watch;
    void visit(ConfigArchive& a);
  };
  using PoseSource = std::function<Pose2()>;
  MoveArm(Config config, const RobotGeometry& robot, const ArenaMap& arena,
          ArmController& controller, const Arm& arm, PoseSource pose);
  ~MoveArm() override;
  /// From then on each path is held against the live cloud before the arm moves. nullptr: not.
  void setSurroundings(const Surroundings* surroundings);
  void setTerms(ArmMoveTerms terms) override;
  /// Joint-space move, rad.
  void startJoints(const Vector6d& q_goal, Stamp now) override;
  void startTimed(const Vector6d& q_goal, double duration_s, Stamp now) override;
  /// Flange pose in base; the solution nearest to the present joints that is free of collision
  /// along the way.
  void startPose(const Eigen::Isometry3d& X_base_flange, Stamp now) override;
  /// Straight lines through flange poses in base, jerk-limited, without stopping when `blend`.
  void startCartesian(std::vector<Eigen::Isometry3d> X_base_flange, bool blend, Stamp now) override;
  void startBack(double seconds, Stamp now) override;
  [[nodiscard]] SkillStatus poll(Stamp now) override;
  void cancel() override;  ///< arm decelerates and holds
  /// Reachable and free of collision now? Error says why not.
  [[nodiscard]] Result<Vector6d> check(const Eigen::Isometry3d& X_base_flange) const override;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace kiln
