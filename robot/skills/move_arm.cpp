#include "robot/skills/move_arm.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <variant>

#include <fmt/format.h>

#include "common/core/log.h"
#include "common/core/units.h"
#include "robot/planning/arm_motion/joint_trajectory.h"
#include "robot/planning/arm_motion/ur_inverse.h"
#include "robot/scene/obstacles.h"
#include "robot/skills/arm_postures.h"

namespace kiln {
namespace {

constexpr double kAnswerTime = 0.1;  // s; until the control thread has seen the first setpoint
constexpr double kCarriedOn = 0.06;  // s; the controller follows a setpoint on for so long
// Part of the guard force: an arm that lags while this much pushes against it may have met
// something.
constexpr double kTouched = 0.5;
// Part of the guard force: so much more than at its start may press on a move that leaves a
// contact.
constexpr double kPressedHarder = 0.5;
constexpr double kAheadStep_m = 0.02;  // along a line that is only looked at

struct PoseGoal {
  Eigen::Isometry3d X_base_flange;
};
struct LineGoal {
  std::vector<Eigen::Isometry3d> X_base_flange;
  bool blend = false;
};
struct TimedGoal {
  Vector6d q;
  double duration_s = 0.0;
};
using Goal = std::variant<Vector6d, PoseGoal, LineGoal, TimedGoal>;

}  // namespace

struct MoveArm::Impl {
  enum class Stage { Idle, Settling, Planning, Moving };

  Impl(Config c, const RobotGeometry& geometry, const ArenaMap& arena_map,
       ArmController& arm_controller, const Arm& device, PoseSource source)
      : config(withClearance(std::move(c))),
        robot(geometry),
        arena(arena_map),
        controller(arm_controller),
        arm(device),
        pose(std::move(source)),
        collision(geometry),
        planner(config.planner, geometry, collision) {}

  static Config withClearance(Config c) {
    c.planner.clearance_m = c.cartesian.clearance_m = c.clearance_m;
    return c;
  }

  void start(Goal wanted, Stamp now) {
    goal = std::move(wanted);
    terms = next_terms;
    stage = Stage::Settling;
    status = {SkillPhase::Running, 0.0, "coming to rest", ""};
    trajectory.reset();
    resumes = 0;
    stage_began = last = now;
    hold(now);
  }

  std::optional<Vector6d> beforeTheEnd(double seconds) const {
    if (!trajectory) return std::nullopt;
    const double end = std::min(toSeconds(streamed - stage_began), trajectory->duration());
    return trajectory->at(std::max(0.0, end - seconds)).q;
  }

  /// Again from where the arm comes to rest, if nothing was touched and not too often.
  SkillStatus interrupted(const ArmTracking& tracking, std::string why, Stamp now) {
    const double guard_n = guardForce();
    const bool touched = guard_n > 0.0 && tracking.contact_force_n > kTouched * guard_n;
    const bool once = std::holds_alternative<TimedGoal>(goal);
    if (touched || once || resumes >= config.max_resumes) {
      if (resumes > 0) why += fmt::format(" (after {} new tries)", resumes);
      return fail("tracking", std::move(why), now);
    }
    ++resumes;
    dropPosesBehind();
    logger("arm")->info("interrupted: {}; going on", why);
    status.text = "interrupted: " + why;
    enter(Stage::Settling, now);
    hold(now);
    return status;
  }

  void dropPosesBehind() {
    auto* lines = std::get_if<LineGoal>(&goal);
    if (!lines || !trajectory) return;
    const double covered = trajectory->covered(toSeconds(streamed - stage_began));
    const std::size_t behind =
        posesBehind(config.cartesian, robot.X_base_flange(q_start), lines->X_base_flange, covered);
    lines->X_base_flange.erase(lines->X_base_flange.begin(),
                               lines->X_base_flange.begin() + static_cast<std::ptrdiff_t>(behind));
  }

  void hold(Stamp now) {
    ArmSetpoint setpoint;
    setpoint.stamp = now;
    controller.setpoint(setpoint);
  }

  SkillStatus fail(const char* code, std::string text, Stamp now) {
    hold(now);
    stage = Stage::Idle;
    status.phase = SkillPhase::Failed;
    status.failure_code = code;
    status.text = std::move(text);
    return status;
  }

  void enter(Stage next, Stamp now) {
    stage = next;
    stage_began = now;
  }

  SkillStatus poll(Stamp now) {
    if (status.phase != SkillPhase::Running) return status;
    const double gap_s = toSeconds(now - std::exchange(last, now));
    const ArmTracking tracking = controller.tracking();
    if (tracking.protective_stop) return fail("protective_stop", tracking.blocked, now);
    if (tracking.stop_latched) return fail("stopped", tracking.blocked, now);
    switch (stage) {
      case Stage::Settling:
        return settle(tracking, now);
      case Stage::Planning:
        return search(now);
      case Stage::Moving:
        return move(tracking, gap_s, now);
      case Stage::Idle:
        break;
    }
    return status;
  }

  SkillStatus settle(const ArmTracking& tracking, Stamp now) {
    hold(now);
    // Only a tick after the Hold tells whether the arm rests.
    const bool answered = tracking.stamp > stage_began;
    if (answered && tracking.ready && tracking.at_rest && !tracking.contact_stop) {
      q_start = tracking.q_command;
      return plan(now);
    }
    if (toSeconds(now - stage_began) > config.settle_timeout_s) {
      return fail("tracking",
                  tracking.blocked.empty() ? "the arm does not come to rest"
                                           : "the arm is not ready: " + tracking.blocked,
                  now);
    }
    return status;
  }

  SkillStatus plan(Stamp now) {
    collision.setScene(obstacles(arena), pose(), terms.scene);
    collision.setCarried(terms.carried);
    if (const auto* lines = std::get_if<LineGoal>(&goal)) return planLines(*lines, now);
    if (const auto* timed = std::get_if<TimedGoal>(&goal)) return planTimed(*timed, now);
    std::vector<Vector6d> goals;
    if (const auto* q = std::get_if<Vector6d>(&goal)) {
      if (!withinLimits(robot.arm, *q)) {
        return fail("unreachable", "the goal is outside the joint limits", now);
      }
      goals = {*q};
    } else {
      goals = posturesFor(robot, std::get<PoseGoal>(goal).X_base_flange, q_start);
      if (goals.empty()) return fail("unreachable", "no arm posture reaches the pose", now);
    }
    std::string nearest;
    std::erase_if(goals, [&](const Vector6d& q) {
      return !hasRoom(collision, q, clearance(terms), nearest);
    });
    if (goals.empty()) return fail("in_collision", "the goal is too near: " + nearest, now);
    if (auto kept = keepWithLine(terms, goals); !kept)
      return fail(failureOf(kept.error()), kept.error().message, now);
    enter(Stage::Planning, now);
    return proceed(planner.start(q_start, goals, {clearance(terms), terms.keep_tilt}), now);
  }

  SkillStatus planLines(const LineGoal& lines, Stamp now) {
    for (const Eigen::Isometry3d& X : lines.X_base_flange) {
      if (!isFinite(X)) return fail("unreachable", "the pose is not a number", now);
    }
    if (lines.X_base_flange.empty()) return fail("unreachable", "no pose to go to", now);
    CartesianPathConfig demand = config.cartesian;
    demand.clearance_m = clearance(terms);
    auto paths =
        cartesianPaths(robot, collision, demand, q_start, lines.X_base_flange, lines.blend);
    if (!paths) return fail(failureOf(paths.error()), paths.error().message, now);
    JointPathLimits limits = jointLimits();
    limits.path_speed = terms.line_speed_mps.value_or(config.cartesian_speed_mps);
    limits.path_accel = config.cartesian_accel_mps2;
    return begin(std::move(*paths), limits, now);
  }

  static const char* failureOf(const Error& error) {
    return error.code == ErrorCode::Refused ? "in_collision" : "unreachable";
  }

  /// Leaves those from which the line ahead can be followed. Error: none is left, and why not from
  /// the first one.
  Result<void> keepWithLine(const ArmMoveTerms& of, std::vector<Vector6d>& goals) const {
    if (!of.ahead) return {};
    ArmCollision world(robot);
    world.setScene(obstacles(arena), pose(), {of.scene.boxes, of.ahead->touchable});
    world.setCarried(of.carried);
    CartesianPathConfig demand = config.cartesian;
    demand.clearance_m = of.ahead->clearance_m;
    demand.step_m = kAheadStep_m;
    std::optional<Error> why;
    std::erase_if(goals, [&](const Vector6d& q) {
      const auto paths =
          cartesianPaths(robot, world, demand, q, of.ahead->X_base_flange, /*blend=*/false);
      if (!paths && !why) why = paths.error();
      return !paths;
    });
    if (!goals.empty() || !why) return {};
    return tl::make_unexpected(*why);
  }

  SkillStatus planTimed(const TimedGoal& timed, Stamp now) {
    if (!withinLimits(robot.arm, timed.q) || !(timed.duration_s > 0.0))
      return fail("unreachable", "the goal is outside the joint limits", now);
    std::string nearest;
    if (!hasRoom(collision, timed.q, config.clearance_m, nearest))
      return fail("in_collision", "the goal is too near: " + nearest, now);
    if (!collision.pathIsFree(q_start, timed.q, config.clearance_m))
      return fail("in_collision", "the straight way to the goal is not free", now);
    JointPath path = straightJointPath(q_start, timed.q);
    const JointPathLimits limits = slowedTo(path, jointLimits(), timed.duration_s);
    return begin({std::move(path)}, limits, now);
  }

  JointPathLimits jointLimits() const {
    JointPathLimits limits;
    limits.speed = terms.speed_scale.value_or(config.speed_scale) * robot.arm.velocity_limit;
    limits.accel = Vector6d::Constant(terms.joint_accel_radps2.value_or(config.joint_accel_radps2));
    limits.jerk_time_s = config.jerk_time_s;
    return limits;
  }

  SkillStatus search(Stamp now) {
    hold(now);
    return proceed(planner.advance(config.planning_slice), now);
  }

  SkillStatus proceed(ArmPlanner::Progress progress, Stamp now) {
    if (progress == ArmPlanner::Progress::Failed) {
      const Clearance here = collision.clearance(q_start);
      return fail("in_collision",
                  here.distance_m <= 0.0 ? "the arm already touches: " + here.what
                                         : "no way around the obstacles was found",
                  now);
    }
    if (progress == ArmPlanner::Progress::Running) {
      status.text = fmt::format("planning, {} tries", planner.iterations());
      return status;
    }
    std::vector<JointPath> paths;
    for (std::size_t k = 1; k < planner.path().size(); ++k) {
      paths.push_back(straightJointPath(planner.path()[k - 1], planner.path()[k]));
    }
    return begin(std::move(paths), jointLimits(), now);
  }

  SkillStatus begin(std::vector<JointPath> paths, const JointPathLimits& limits, Stamp now) {
    if (surroundings && terms.watch) {
      std::string why =
          whatHindersArm(config.watch, collision, robot.X_base_armbase.pose().translation(), paths,
                         terms.scene.boxes, *surroundings, now);
      if (!why.empty()) return fail("obstacle", std::move(why), now);
    }
    trajectory.emplace(std::move(paths), limits);
    streamed = now;
    pressed_n = controller.tracking().contact_force_n;
    enter(Stage::Moving, now);
    stream(now);
    return status;
  }

  /// Something may press already, namely what the arm met and now leaves.
  [[nodiscard]] double guard() const {
    const double guard_n = guardForce();
    if (guard_n <= 0.0) return 0.0;
    return std::max(guard_n, pressed_n + kPressedHarder * guard_n);
  }
  [[nodiscard]] double guardForce() const {
    return terms.guard_force_n.value_or(config.guard_force_n);
  }
  [[nodiscard]] double clearance(const ArmMoveTerms& of) const {
    return of.clearance_m.value_or(config.clearance_m);
  }

  void stream(Stamp now) {
    const JointTrajectory::Point point = trajectory->at(toSeconds(now - stage_began));
    ArmSetpoint setpoint;
    setpoint.kind = ArmSetpoint::Kind::Joints;
    setpoint.stamp = now;
    setpoint.q = point.q;
    setpoint.qd = point.qd;
    setpoint.stop_force_n = guard();
    controller.setpoint(setpoint);
    streamed = now;
  }

  SkillStatus move(const ArmTracking& tracking, double gap_s, Stamp now) {
    if (tracking.contact_stop) return fail("contact", tracking.blocked, now);
    if (gap_s > config.max_gap_s)
      return interrupted(tracking, fmt::format("no setpoint for {:.2f} s", gap_s), now);
    // The controller has stopped following by then: the reference waits, it does not jump ahead.
    if (gap_s > kCarriedOn) stage_began += fromSeconds(gap_s - kCarriedOn);
    const double t = toSeconds(now - stage_began);
    const bool answered = t > kAnswerTime;
    if (answered && !tracking.blocked.empty()) return interrupted(tracking, tracking.blocked, now);
    if (answered && now - tracking.stamp > std::chrono::milliseconds(500)) {
      return fail("timeout", "the control loop does not answer", now);
    }
    pressed_n = std::min(pressed_n, tracking.contact_force_n);
    stream(now);
    const double left = std::max(0.0, trajectory->duration() - t);
    status.progress = trajectory->duration() > 0.0 ? 1.0 - left / trajectory->duration() : 1.0;
    status.text = fmt::format("{:.1f} s to go", left);
    if (left > 0.0) return status;
    const std::optional<ArmState> state = arm.state();
    const double off = state ? (state->q - trajectory->goal()).cwiseAbs().maxCoeff() : INFINITY;
    if (answered && tracking.at_rest && off < config.goal_tolerance_deg * kDeg) {
      stage = Stage::Idle;
      status = {SkillPhase::Done, 1.0, "there", ""};
    } else if (t > trajectory->duration() + config.settle_timeout_s) {
      return interrupted(tracking, fmt::format("the arm stays {:.1f} deg off its goal", off / kDeg),
                         now);
    }
    return status;
  }

  Result<Vector6d> check(const Eigen::Isometry3d& X_base_flange) const {
    const std::optional<ArmState> state = arm.state();
    auto goals = posturesFor(robot, X_base_flange, state ? state->q : Vector6d::Zero());
    if (goals.empty()) return makeError(ErrorCode::Degenerate, "no arm posture reaches the pose");
    ArmCollision world(robot);
    world.setScene(obstacles(arena), pose(), next_terms.scene);
    world.setCarried(next_terms.carried);
    std::string nearest;
    std::erase_if(goals, [&](const Vector6d& q) {
      return !hasRoom(world, q, clearance(next_terms), nearest);
    });
    if (goals.empty()) return makeError(ErrorCode::Refused, "the pose is too near: {}", nearest);
    if (auto kept = keepWithLine(next_terms, goals); !kept)
      return tl::make_unexpected(kept.error());
    return goals.front();
  }

  Config config;
  const RobotGeometry& robot;
  const ArenaMap& arena;
  const Surroundings* surroundings = nullptr;
  ArmController& controller;
  const Arm& arm;
  PoseSource pose;
  ArmCollision collision;
  ArmPlanner planner;
  ArmMoveTerms terms, next_terms;  ///< of the move that runs; of those that follow
  Goal goal = Vector6d(Vector6d::Zero());
  Stage stage = Stage::Idle;
  int resumes = 0;
  Stamp stage_began, last, streamed;
  double pressed_n = 0.0;  ///< least contact force since the move began
  Vector6d q_start = Vector6d::Zero();
  std::optional<JointTrajectory> trajectory;
  SkillStatus status;
};

MoveArm::MoveArm(Config config, const RobotGeometry& robot, const ArenaMap& arena,
                 ArmController& controller, const Arm& arm, PoseSource pose)
    : impl_(std::make_unique<Impl>(std::move(config), robot, arena, controller, arm,
                                   std::move(pose))) {}
MoveArm::~MoveArm() = default;

void MoveArm::setSurroundings(const Surroundings* surroundings) {
  impl_->surroundings = surroundings;
}

void MoveArm::setTerms(ArmMoveTerms terms) { impl_->next_terms = std::move(terms); }

void MoveArm::startJoints(const Vector6d& q_goal, Stamp now) { impl_->start(q_goal, now); }

void MoveArm::startTimed(const Vector6d& q_goal, double duration_s, Stamp now) {
  impl_->start(TimedGoal{q_goal, duration_s}, now);
}

void MoveArm::startPose(const Eigen::Isometry3d& X_base_flange, Stamp now) {
  impl_->start(PoseGoal{X_base_flange}, now);
}

void MoveArm::startCartesian(std::vector<Eigen::Isometry3d> X_base_flange, bool blend, Stamp now) {
  impl_->start(LineGoal{std::move(X_base_flange), blend}, now);
}

void MoveArm::startBack(double seconds, Stamp now) {
  if (const auto q = impl_->beforeTheEnd(seconds)) {
    impl_->start(*q, now);
  } else {
    impl_->stage = Impl::Stage::Idle;
    impl_->status = {SkillPhase::Done, 1.0, "nothing to go back on", ""};
  }
}

SkillStatus MoveArm::poll(Stamp now) { return impl_->poll(now); }

void MoveArm::cancel() {
  if (impl_->status.phase == SkillPhase::Running) impl_->hold(impl_->last);
  impl_->stage = Impl::Stage::Idle;
  impl_->status = {SkillPhase::Idle, 0.0, "cancelled", ""};
}

Result<Vector6d> MoveArm::check(const Eigen::Isometry3d& X_base_flange) const {
  return impl_->check(X_base_flange);
}

}  // namespace kiln
