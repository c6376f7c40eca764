#include "robot/skills/drive_to.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "common/core/units.h"
#include "robot/planning/base_path/base_path.h"
#include "robot/scene/obstacles.h"
#include "robot/skills/arena_fence.h"
#include "robot/skills/stuck_watch.h"

namespace kiln {
namespace {

constexpr double kLookAhead = 0.5;   // s; where the wheels shall point before the base moves
constexpr double kRateChange = 3.0;  // 1/s; how fast the reference slows down and picks up
constexpr double kMaxTick = 0.1;     // s

bool isFinite(const Pose2& p) {
  return std::isfinite(p.x_m) && std::isfinite(p.y_m) && std::isfinite(p.yaw_rad);
}

Eigen::Vector2d clampNorm(Eigen::Vector2d v, double limit) {
  return v.norm() > limit ? Eigen::Vector2d(v * (limit / v.norm())) : v;
}

}  // namespace

void DriveTo::Config::visit(ConfigArchive& a) {
  a.field("speed_mps", speed_mps, "m/s", 0.05, 4, "on straight lines");
  a.field("approach_speed_mps", approach_speed_mps, "m/s", 0.02, 4, "near the end");
  a.field("approach_distance_m", approach_distance_m, "m", 0, 5, "where the end begins");
  a.field("position_tolerance_m", position_tolerance_m, "m", 0.002, 1, "at the end");
  a.field("yaw_tolerance_deg", yaw_tolerance_deg, "deg", 0.05, 30, "at the end");
  a.field("position_gain", position_gain, "1/s", 0.1, 5, "error to correcting speed");
  a.field("yaw_gain", yaw_gain, "1/s", 0.1, 5, "error to correcting yaw rate");
  a.field("corner_radius_m", corner_radius_m, "m", 0, 3, "way-points are passed within this");
  a.field("timeout_factor", timeout_factor, "", 1, 20, "of the expected duration");
  a.field("timeout_slack_s", timeout_slack_s, "s", 0, 120, "and this much more");
  a.field("accel_mps2", accel_mps2, "m/s^2", 0.05, 3, "along the path and across it");
  a.field("yaw_rate_radps", yaw_rate_radps, "rad/s", 0.05, 3, "turning speed");
  a.field("jerk_time_s", jerk_time_s, "s", 0.02, 2, "ramp of the acceleration");
  a.field("max_correction_mps", max_correction_mps, "m/s", 0.02, 1, "against position errors");
  a.field("max_correction_radps", max_correction_radps, "rad/s", 0.02, 2, "against yaw errors");
  a.field("slow_error_m", slow_error_m, "m", 0.02, 2, "lag from which the reference slows down");
  a.field("wait_error_m", wait_error_m, "m", 0.05, 5, "lag at which the reference waits");
  a.field("settle_s", settle_s, "s", 0, 5, "within tolerance and at rest");
  a.field("geofence_slack_m", geofence_slack_m, "m", 0, 5, "base may pass the fence by this");
  a.field("stuck_window_s", stuck_window_s, "s", 0.5, 30, "time over which the way is compared");
  a.field("stuck_ratio", stuck_ratio, "", 0.01, 0.9, "less of the commanded way is stuck");
  a.field("edge_speed_mps", edge_speed_mps, "m/s", 0.05, 2, "over the edge before the door");
  a.field("edge_distance_m", edge_distance_m, "m", 0, 2, "slow from so far before it on");
  a.section("guard", guard, "live cloud ahead of the driving base");
  a.section("fence", fence, "way-points against the arena's border");
}

struct DriveTo::Impl {
  Impl(Config c, const RobotGeometry& geometry, const ArenaMap& arena_map,
       BaseController& controller, PoseSource source)
      : config(c),
        robot(geometry),
        arena(arena_map),
        base(controller),
        pose(std::move(source)),
        guard(c.guard),
        fence(arenaFence(arena_map, geometry, c.fence)),
        stuck({c.stuck_window_s, c.stuck_ratio, path_config.turn_weight_m}) {
    path_config.speed_mps = c.speed_mps;
    path_config.approach_speed_mps = c.approach_speed_mps;
    path_config.approach_distance_m = c.approach_distance_m;
    path_config.yaw_rate_radps = c.yaw_rate_radps;
    path_config.accel_mps2 = c.accel_mps2;
    path_config.jerk_time_s = c.jerk_time_s;
    path_config.corner_radius_m = c.corner_radius_m;
  }

  bool inFence(const Pose2& p, double slack) const { return fence->room(p) >= -slack; }

  void send(const Twist2& twist, Stamp now) {
    BaseSetpoint setpoint;
    setpoint.stamp = now;
    setpoint.twist = twist;
    base.setpoint(setpoint);
  }

  SkillStatus fail(const char* code, std::string text, Stamp now) {
    send({}, now);
    status.phase = SkillPhase::Failed;
    status.failure_code = code;
    status.text = std::move(text);
    return status;
  }

  void begin(Stamp now) {
    status = {SkillPhase::Running, 0.0, "starting", ""};
    path.reset();
    clock_s = 0.0;
    rate = take_off = 1.0;
    arrived = false;
    settled_since.reset();
    began = last = now;
    guard.restart();
    hindrance.clear();
    speed_limit = 1e9;
    const Pose2 here = pose();
    if (!fence) {
      fail("geofence", fence.error().message, now);
      return;
    }
    if (!isFinite(here)) {
      fail("no_pose", "the pose of the base is not known", now);
      return;
    }
    if (waypoints.empty()) waypoints.push_back(here);
    for (const Pose2& waypoint : waypoints) {
      if (isFinite(waypoint) && inFence(waypoint, 0.0)) continue;
      fail("geofence",
           fmt::format("way-point ({:.2f}, {:.2f}) is outside the geofence", waypoint.x_m,
                       waypoint.y_m),
           now);
      return;
    }
    path.emplace(here, waypoints, path_config);
    const auto leaves = [&](const Pose2& on_the_way) {
      return !inFence(on_the_way, std::max(config.geofence_slack_m, -fence->room(here)));
    };
    if (std::any_of(path->samples().begin(), path->samples().end(), leaves)) {
      fail("geofence", "the way between the way-points leaves the geofence", now);
      return;
    }
    const auto hit = firstObstacle(*path, robot.length_m, robot.width_m, obstacles(arena));
    if (hit) fail("in_collision", "the way leads through: " + *hit, now);
    stuck.restart(now, here);
  }

  /// While any part of the base is near the surveyed edge.
  double edgeRate() const {
    if (arena.approach.edge_m <= 0.0) return 1.0;
    const BasePath::Point ref = path->at(clock_s);
    const double speed = std::hypot(ref.v_map.vx_mps, ref.v_map.vy_mps);
    const double away = std::abs(ref.X_map_base.x_m - arena.approach.edge_x_m);
    if (away > 0.5 * robot.length_m + config.edge_distance_m) return 1.0;
    return std::min(1.0, config.edge_speed_mps / std::max(1e-6, speed));
  }

  /// The reference moves on in its own time, slower when the base lags behind, not at all while
  /// wheels turn.
  void advanceReference(double dt, double error_m, bool aligning) {
    double wanted =
        (config.wait_error_m - error_m) / std::max(1e-6, config.wait_error_m - config.slow_error_m);
    wanted = aligning ? 0.0 : std::clamp(wanted, 0.0, 1.0);
    wanted = std::min(wanted, edgeRate());
    const Twist2 v = path->at(clock_s).v_map;
    const double speed = std::hypot(v.vx_mps, v.vy_mps, path_config.turn_weight_m * v.wz_radps);
    if (speed > speed_limit) wanted = std::min(wanted, speed_limit / speed);
    if (speed_limit <= 0.0) wanted = 0.0;  // also before the first step, where the speed is zero
    rate += std::clamp(wanted - rate, -kRateChange * dt, kRateChange * dt);
    clock_s += rate * dt;
  }

  /// Share of the wished speed that edge and obstacles leave.
  double allowedShare(double speed) const {
    return std::min(edgeRate(), speed > speed_limit ? std::max(0.0, speed_limit) / speed : 1.0);
  }

  /// The reference's velocity and the correction. While the wheels turn, and until the base has
  /// taken off, that of a little later: the slow beginning alone would leave the direction to the
  /// correction, and the wheels would have to turn again.
  Twist2 command(const BasePath::Point& ref, const Pose2& here, bool aligning) const {
    Eigen::Vector2d v_map(ref.v_map.vx_mps, ref.v_map.vy_mps);
    double wz = ref.v_map.wz_radps;
    if (aligning || take_off < 1.0 || clock_s <= 0.0) {
      const BasePath::Point ahead = path->at(clock_s + kLookAhead);
      v_map = {ahead.v_map.vx_mps, ahead.v_map.vy_mps};
      wz = ahead.v_map.wz_radps;
    } else {
      v_map *= rate;
      wz *= rate;
    }
    const Eigen::Vector2d error(ref.X_map_base.x_m - here.x_m, ref.X_map_base.y_m - here.y_m);
    v_map += clampNorm(config.position_gain * error, config.max_correction_mps);
    const double yaw_error = wrapAngle(ref.X_map_base.yaw_rad - here.yaw_rad);
    wz += std::clamp(config.yaw_gain * yaw_error, -config.max_correction_radps,
                     config.max_correction_radps);
    if (!aligning && take_off < 1.0) {
      const double share = std::min(
          take_off, allowedShare(std::hypot(v_map.norm(), path_config.turn_weight_m * wz)));
      v_map *= share;
      wz *= share;
    }
    const double c = std::cos(here.yaw_rad), s = std::sin(here.yaw_rad);
    return {c * v_map.x() + s * v_map.y(), -s * v_map.x() + c * v_map.y(), wz};
  }

  /// Within half the tolerance the base is let go to rest; beyond the whole it corrects again.
  void judgeArrival(double distance_m, double yaw_error_rad) {
    const double size = std::max(distance_m / config.position_tolerance_m,
                                 std::abs(yaw_error_rad) / (config.yaw_tolerance_deg * kDeg));
    const bool path_done = clock_s >= path->duration();
    arrived = path_done && size < (arrived ? 1.0 : 0.5);
  }

  SkillStatus poll(Stamp now) {
    if (status.phase != SkillPhase::Running) return status;
    const double dt = std::clamp(toSeconds(now - last), 0.0, kMaxTick);
    const Stamp previous = std::exchange(last, now);
    const BaseTracking tracking = base.tracking();
    const Pose2 here = pose();
    if (!isFinite(here)) return fail("no_pose", "the pose of the base is not known", now);
    if (tracking.stop_latched) return fail("stopped", tracking.blocked, now);
    if (!inFence(here, config.geofence_slack_m)) {
      return fail("geofence", "the base is outside the geofence", now);
    }
    if (stuck.update(now, dt, here, tracking.commanded, tracking.measured)) {
      return fail("stuck", "the base does not follow its wheels' command", now);
    }
    if (path->duration() > 0.0 && surroundings) {
      const CorridorGuard::View ahead = guard.look(*surroundings, *path, path->at(clock_s).s, here,
                                                   robot.length_m, robot.width_m, now);
      speed_limit = ahead.max_speed_mps;
      hindrance = ahead.reason;
      if (ahead.given_up) return fail("blocked", ahead.reason, now);
      if (speed_limit <= 0.0) began += now - previous;  // waiting is not being late
    }
    const double limit = config.timeout_factor * path->duration() + config.timeout_slack_s;
    if (toSeconds(now - began) > limit) {
      return fail("timeout", fmt::format("not there after {:.0f} s", limit), now);
    }
    const BasePath::Point lag_ref = path->at(clock_s);
    const double lag =
        std::hypot(lag_ref.X_map_base.x_m - here.x_m, lag_ref.X_map_base.y_m - here.y_m);
    advanceReference(dt, lag, tracking.aligning);
    take_off = tracking.aligning ? 0.0 : std::min(1.0, take_off + kRateChange * dt);
    const BasePath::Point ref = path->at(clock_s);
    next = path->nextWaypoint(ref.s);
    const Pose2& goal = waypoints.back();
    const double to_go = std::hypot(goal.x_m - here.x_m, goal.y_m - here.y_m);
    judgeArrival(to_go, wrapAngle(goal.yaw_rad - here.yaw_rad));
    const bool waiting = speed_limit <= 0.0 && rate <= 0.0;
    send(arrived || waiting ? Twist2{} : command(ref, here, tracking.aligning), now);
    if (!arrived || !tracking.at_rest) settled_since.reset();
    if (arrived && tracking.at_rest && !settled_since) settled_since = now;
    status.progress = path->length() > 0.0 ? ref.s / path->length() : 1.0;
    status.text = fmt::format("{:.2f} m to go", to_go);
    if (!tracking.limited.empty()) status.text += "; " + tracking.limited;
    if (!hindrance.empty()) status.text = hindrance;
    if (settled_since && toSeconds(now - *settled_since) >= config.settle_s) {
      status = {SkillPhase::Done, 1.0, fmt::format("there, {:.0f} mm off", 1e3 * to_go), ""};
    }
    return status;
  }

  Config config;
  BasePathConfig path_config;
  const RobotGeometry& robot;
  const ArenaMap& arena;
  BaseController& base;
  PoseSource pose;
  CorridorGuard guard;
  Result<Geofence> fence;
  const Surroundings* surroundings = nullptr;
  double speed_limit = 1e9;
  std::string hindrance;
  std::vector<Pose2> waypoints;
  std::optional<BasePath> path;
  StuckWatch stuck;
  SkillStatus status;
  Stamp began, last;
  std::optional<Stamp> settled_since;
  double clock_s = 0.0, rate = 1.0;
  double take_off = 1.0;  ///< from 0 to 1 after the wheels have turned
  int next = 0;
  bool arrived = false;
};

DriveTo::DriveTo(Config config, const RobotGeometry& robot, const ArenaMap& arena,
                 BaseController& base, PoseSource pose)
    : impl_(std::make_unique<Impl>(config, robot, arena, base, std::move(pose))) {}
DriveTo::~DriveTo() = default;

void DriveTo::setSurroundings(const Surroundings* surroundings) {
  impl_->surroundings = surroundings;
}

void DriveTo::start(std::vector<Pose2> waypoints_map, Stamp now) {
  impl_->waypoints = std::move(waypoints_map);
  impl_->next = 0;
  impl_->begin(now);
}

SkillStatus DriveTo::poll(Stamp now) { return impl_->poll(now); }

void DriveTo::cancel() {
  if (impl_->status.phase == SkillPhase::Running) impl_->send({}, impl_->last);
  impl_->status = {SkillPhase::Idle, 0.0, "cancelled", ""};
}

const std::vector<Pose2>& DriveTo::waypoints() const { return impl_->waypoints; }
int DriveTo::nextIndex() const { return impl_->next; }

}  // namespace kiln
