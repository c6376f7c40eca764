#include "robot/evaluation/wall/wall_rig.h"

#include <utility>

#include "robot/app/scan_preparation.h"

namespace kiln {
namespace {

constexpr double kMotionLimit_s = 60.0, kFirstScans_s = 1.0, kPoll_s = 0.04;
constexpr int kStepsOfATick = 2;  // of the mission, in control periods

}  // namespace

WallRig::WallRig(const RobotGeometry& robot, const ArenaMap& arena, WallRigDevices devices)
    : robot_(robot),
      arena_(arena),
      devices_(std::move(devices)),
      arm_({}, robot_, devices_.arm, stop_),
      base_({}, robot_, devices_.base, stop_),
      mover_({}, robot_, arena_, arm_, devices_.arm, [this] { return pose(); }),
      drive_({}, robot_, arena_, base_, [this] { return pose(); }),
      self_filter_(robot_, {}),
      surroundings_(surroundings_config_),
      sweep_({}, mover_, [this] { return surroundings_.scans(); }) {
  mover_.setSurroundings(&surroundings_);
  drive_.setSurroundings(&surroundings_);
}

WallRig::~WallRig() { devices_.lidar.stop(); }

Pose2 WallRig::pose() const { return arena_.start.pose() * base_.tracking().X_odom_base; }

Vector6d WallRig::joints() const {
  const auto state = devices_.arm.state();
  return state ? state->q : RobotGeometry::radians(robot_.q_drive_deg);
}

Result<void> WallRig::begin() {
  if (auto on = devices_.lidar.start([this](PointCloudPtr s) { scan_ = std::move(s); }); !on)
    return on;
  if (auto passed = pass(kFirstScans_s); !passed) return passed;
  if (surroundings_.scans().empty())
    return makeError(ErrorCode::Timeout, "no LiDAR scan; check its cable and power");
  return {};
}

Result<void> WallRig::pass(double seconds) {
  const Stamp until = devices_.clock.now() + fromSeconds(seconds);
  while (devices_.clock.now() < until) {
    if (auto stepped = devices_.step(); !stepped) return stepped;
    const Stamp now = devices_.clock.now();
    const auto wheels = devices_.base.state();
    base_.tick(now);
    arm_.tick(now);
    if (const auto arm = devices_.arm.state()) history_.addJoints(arm->stamp, arm->q);
    if (wheels) history_.addOdometry(wheels->stamp, base_.tracking().X_odom_base);
    if (++steps_ % kStepsOfATick != 0) continue;
    prepare();
    surroundings_.tick(base_.tracking().X_odom_base);
    if (skill_) status_ = skill_(now);
  }
  return {};
}

void WallRig::prepare() {
  const PointCloudPtr scan = std::exchange(scan_, nullptr);
  if (!scan) return;
  const PreparedScan prepared = prepareScan(*scan, robot_, history_, self_filter_);
  const auto sample = history_.at(scan->stamp);
  if (!prepared.X_base_lidar || !sample) return;
  const Eigen::Isometry3d X_base_lidar = prepared.X_base_lidar->at(scan->stamp);
  surroundings_.add(
      {prepared.cloud,
       ObstacleMemory::observe(surroundings_config_.obstacles, *prepared.cloud, X_base_lidar),
       sample->X_odom_base, toIsometry(arena_.start.pose() * sample->X_odom_base),
       prepared.X_base_lidar});
}

Result<void> WallRig::finish(const std::function<SkillStatus(Stamp)>& poll, double limit_s) {
  skill_ = poll;
  status_ = {SkillPhase::Running, 0.0, {}, {}};
  const Stamp limit = devices_.clock.now() + fromSeconds(limit_s);
  while (status_.phase == SkillPhase::Running) {
    if (auto passed = pass(kPoll_s); !passed) return passed;
    if (devices_.clock.now() > limit)
      return makeError(ErrorCode::Timeout, "not done within {:.0f} s: {}", limit_s, status_.text);
  }
  skill_ = nullptr;
  if (status_.phase == SkillPhase::Done) return {};
  return makeError(ErrorCode::Refused, "{}: {}", status_.failure_code, status_.text);
}

Result<void> WallRig::driveTo(const Pose2& X_map_base) {
  drive_.start({X_map_base}, devices_.clock.now());
  return finish([this](Stamp now) { return drive_.poll(now); }, kMotionLimit_s);
}

Result<SweepCloud> WallRig::sweep(const SweepMotion& motion) {
  sweep_.start(motion, devices_.clock.now());
  const auto done = finish([this](Stamp now) { return sweep_.poll(now); }, kMotionLimit_s);
  if (!done) return tl::make_unexpected(done.error());
  return sweep_.cloud();
}

}  // namespace kiln
