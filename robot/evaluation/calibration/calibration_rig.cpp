#include "robot/evaluation/calibration/calibration_rig.h"

#include <algorithm>
#include <utility>

#include "common/core/log.h"
#include "common/robot_model/robot_calibration.h"

namespace kiln {
namespace {

constexpr double kMotionLimit_s = 40.0, kFrameLimit_s = 3.0, kPeriod_s = 0.008;

MoveArm::Config motionConfig(const CalibrationRig::Config& config) {
  MoveArm::Config out;
  out.speed_scale = config.speed_scale;
  return out;
}

/// The robot was put down by eye, and so was the plate: the arm keeps away from where things may
/// be.
ArenaMap withRoomForError(const CalibrationYard& yard) {
  constexpr double kError_m = 0.3;
  FireSiteMap site = yard.site;
  site.box_size_m += 2.0 * kError_m;
  site.table_size_m += 2.0 * kError_m;
  site.recess_m += kError_m;
  ArenaMap arena = yard.arena;
  arena.fixtures[kFireSite] = site.fixtures();
  for (BoxConfig& wall : arena.walls)
    for (double& side : wall.size_m) side += 2.0 * kError_m;
  return arena;
}

}  // namespace

double spread(int n, int prime, double limit) {
  double out = 0.0, share = 1.0;
  for (int k = n + 1; k > 0; k /= prime) {
    share /= prime;
    out += share * (k % prime);
  }
  return limit * (2.0 * out - 1.0);
}

CalibrationRig::CalibrationRig(const Config& config, const RobotGeometry& nominal,
                               const CalibrationYard& yard, CalibrationDevices devices)
    : config_(config),
      nominal_(nominal),
      yard_(yard),
      devices_(std::move(devices)),
      planned_yard_(withRoomForError(yard)),
      arm_({}, nominal_, devices_.arm, stop_),
      mover_(motionConfig(config), nominal_, planned_yard_, arm_, devices_.arm,
             [this] { return yard_.arena.start.pose(); }) {
  if (devices_.pumps) pumps_.emplace(PumpController::Config{}, *devices_.pumps, stop_);
}

CalibrationRig::~CalibrationRig() {
  if (!devices_.pumps) return;
  if (auto off = devices_.pumps->write({0.0, 0.0}); !off)
    logger("calibrate")->error("the pumps could not be told to stop: {}", off.error().message);
}

Result<void> CalibrationRig::startSensors() {
  if (auto on = devices_.lidar.start([this](PointCloudPtr s) { scan_ = std::move(s); }); !on)
    return on;
  if (devices_.thermal) {
    auto on = devices_.thermal->start([this](ThermalImagePtr i) { image_ = std::move(i); });
    if (!on) return on;
  }
  return pass(0.5);
}

Result<void> CalibrationRig::pass(double seconds) {
  const Stamp until = devices_.clock.now() + fromSeconds(seconds);
  while (devices_.clock.now() < until) {
    if (auto stepped = devices_.step(); !stepped) return stepped;
    const Stamp now = devices_.clock.now();
    arm_.tick(now);
    if (pumps_) {
      const double duty = spraying_ ? 1.0 : 0.0;
      PumpSetpoint setpoint;
      setpoint.stamp = now;
      setpoint.duty = {duty, duty};
      pumps_->setpoint(setpoint);
      pumps_->tick(now);
    }
    if (++steps_ % 2 == 0) motion_ = mover_.poll(now);
  }
  return {};
}

Result<PointCloudPtr> CalibrationRig::nextScan() {
  const Stamp from = devices_.clock.now();
  while (!scan_ || scan_->stamp < from) {
    if (auto passed = pass(kPeriod_s); !passed) return tl::make_unexpected(passed.error());
    if (devices_.clock.now() > from + fromSeconds(kFrameLimit_s))
      return makeError(ErrorCode::Timeout, "no LiDAR scan; check its cable and power");
  }
  return scan_;
}

Result<ThermalImagePtr> CalibrationRig::nextImage() {
  if (!devices_.thermal)
    return makeError(ErrorCode::Unavailable, "this robot has no thermal camera");
  const Stamp from = devices_.clock.now();
  while (!image_ || image_->stamp < from || image_->ffc == FfcState::Running) {
    if (auto passed = pass(kPeriod_s); !passed) return tl::make_unexpected(passed.error());
    if (devices_.clock.now() > from + fromSeconds(kFrameLimit_s))
      return makeError(ErrorCode::Timeout, "no thermal image; check its USB cable");
  }
  return image_;
}

Result<RgbImagePtr> CalibrationRig::takePicture() {
  if (!devices_.operator_camera)
    return makeError(ErrorCode::Unavailable, "this robot has no operator camera");
  picture_.reset();
  auto on = devices_.operator_camera->start([this](RgbImagePtr p) { picture_ = std::move(p); });
  if (!on) return tl::make_unexpected(on.error());
  const Stamp limit = devices_.clock.now() + fromSeconds(kFrameLimit_s);
  while (!picture_) {
    if (auto passed = pass(kPeriod_s); !passed) return tl::make_unexpected(passed.error());
    if (devices_.clock.now() > limit)
      return makeError(ErrorCode::Timeout, "no picture of the operator camera; check its cable");
  }
  devices_.operator_camera->stop();
  return picture_;
}

Result<void> CalibrationRig::moveTo(const Vector6d& q) {
  mover_.startJoints(q, devices_.clock.now());
  const Stamp limit = devices_.clock.now() + fromSeconds(kMotionLimit_s);
  do {
    if (auto passed = pass(0.04); !passed) return passed;
    if (motion_.phase == SkillPhase::Failed)
      return makeError(ErrorCode::Refused, "{}", motion_.text);
    if (devices_.clock.now() > limit) return makeError(ErrorCode::Timeout, "the arm is not there");
  } while (motion_.phase != SkillPhase::Done);
  return pass(config_.settle_s);
}

Result<Vector6d> CalibrationRig::joints() const {
  const auto state = devices_.arm.state();
  if (!state) return makeError(ErrorCode::Unavailable, "the arm tells no joint angles");
  return state->q;
}

Result<Eigen::Isometry3d> CalibrationRig::flange() const {
  const auto q = joints();
  if (!q) return tl::make_unexpected(q.error());
  return nominal_.X_base_flange(*q);
}

std::vector<Vector6d> CalibrationRig::reachable(
    int first, int count, const std::function<Eigen::Isometry3d(int)>& posture) const {
  constexpr int kTries = 8;  // a posture
  std::vector<Vector6d> found, out;
  for (int i = first; static_cast<int>(found.size()) < count && i < first + kTries * count; ++i) {
    if (const auto q = mover_.check(posture(i)); q) found.push_back(*q);
  }
  Vector6d here = joints().value_or(RobotGeometry::radians(nominal_.q_drive_deg));
  while (!found.empty()) {
    const auto way = [&](const Vector6d& q) { return (q - here).cwiseAbs().maxCoeff(); };
    const auto nearest =
        std::min_element(found.begin(), found.end(),
                         [&](const Vector6d& a, const Vector6d& b) { return way(a) < way(b); });
    here = *nearest;
    out.push_back(here);
    found.erase(nearest);
  }
  return out;
}

Result<int> CalibrationRig::visit(const std::vector<Vector6d>& postures,
                                  const std::function<Result<void>()>& measure) {
  int visited = 0;
  for (const Vector6d& q : postures) {
    if (auto moved = moveTo(q); !moved) {
      if (moved.error().code != ErrorCode::Refused) return tl::make_unexpected(moved.error());
      logger("calibrate")->info("a posture is left out: {}", moved.error().message);
      continue;
    }
    if (auto measured = measure(); !measured) return tl::make_unexpected(measured.error());
    ++visited;
  }
  return visited;
}

void CalibrationRig::spray(bool on) { spraying_ = on; }

Result<PumpTracking> CalibrationRig::pumps() const {
  if (!pumps_) return makeError(ErrorCode::Unavailable, "this robot has no pumps");
  PumpTracking tracking = pumps_->tracking();
  if (!tracking.blocked.empty())
    return makeError(ErrorCode::Unavailable, "the pumps do not spray: {}", tracking.blocked);
  return tracking;
}

Eigen::Isometry3d CalibrationRig::X_base_map() const {
  return toIsometry(inverse(yard_.arena.start.pose()));
}

void CalibrationRig::placeWall(const std::string& name, const Eigen::Isometry3d& X_base_box) {
  for (std::size_t i = 0; i < yard_.arena.walls.size(); ++i) {
    if (yard_.arena.walls[i].name != name) continue;
    planned_yard_.walls[i] = yard_.arena.walls[i];
    planned_yard_.walls[i].center = poseConfig(X_base_map().inverse() * X_base_box);
  }
}

}  // namespace kiln
