#include "robot/app/robot.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "common/config/resources.h"
#include "common/core/log.h"
#include "common/geom/frames.h"
#include "common/robot_model/robot_calibration.h"
#include "robot/app/robot_reporting.h"
#include "robot/app/safety_files.h"
#include "robot/app/standstill.h"
#include "robot/skills/arena_fence.h"

namespace kiln {

namespace {

constexpr double kStandstill_mps = 0.02;
constexpr double kStandstill_radps = 0.03;
constexpr Duration kMissionPeriod = std::chrono::milliseconds(20);
constexpr Duration kHealthPeriod = std::chrono::milliseconds(200);

/// The nominal geometry with what a calibration found of this robot.
Result<RobotGeometry> calibratedGeometry(const RobotGeometry& nominal,
                                         const RobotOptions& options) {
  std::string file = options.calibration;
  if (file.empty() && !options.state_dir.empty()) {
    const std::string kept = options.state_dir + "/calibration.yaml";
    if (std::filesystem::exists(kept)) file = kept;
  }
  if (file.empty()) {
    logger("robot")->info("no calibration: the sensors are believed to sit where they were drawn");
    return nominal;
  }
  logger("robot")->info("sensors calibrated by {}", file);
  return loadCalibrated(file, nominal);
}

}  // namespace

/// The body and the five parts that work on it, in the order in which they are built.
struct Robot::Impl {
  Impl(const RobotSettings& settings, const RobotOptions& options, Devices devices,
       const Clock& clock, Executor& executor, OperatorLink* link, StopLatch& stop,
       RobotGeometry robot, ArenaMap arena, Location location)
      : body(settings, options, std::move(devices), clock, stop, std::move(robot), std::move(arena),
             [this] { return localization.pose(); }),
        localization(body, std::move(location)),
        intake(body, localization.locator(), executor),
        mission(body),
        desk(body, mission, link),
        reporting({body, intake, localization, mission, desk, link}, executor) {}

  [[nodiscard]] Result<void> open(Executor& executor);
  void start(Executor& executor);
  void missionTick(Stamp now);

  void readOdometry(Stamp now);
  [[nodiscard]] bool noticeReset(Stamp now);
  void processPerception(Stamp now);
  void updateBelief(Stamp now);
  void startArenaClock();
  void updateReport();
  void beginReport();
  [[nodiscard]] GateSituation gateSituation(Stamp now) const;

  RobotBody body;
  RobotLocalization localization;
  SensorIntake intake;
  RobotMission mission;
  OperatorDesk desk;
  RobotReporting reporting;
};

void Robot::Impl::missionTick(Stamp now) {
  readOdometry(now);
  processPerception(now);
  desk.control().checkPosition(localization.objection(now), now);
  localization.monitorMotion(now);
  desk.handleCommands(now);
  reporting.runChecks(now);
  updateBelief(now);
  mission.host().goOnWhenAllowed(desk.control().situation(now), now);
  desk.control().step(now);
  startArenaClock();
  updateReport();
  reporting.raiseAlarms(now);
  reporting.publish(now);
  reporting.record(now);
}

void Robot::Impl::readOdometry(Stamp now) {
  if (noticeReset(now)) return;  // the old odometry is still in the tracking of this instant
  localization.addOdometry(now);
  intake.dispatch(now, localization.localizer());
}

/// The robot was carried to its start, now or while this program was dead.
bool Robot::Impl::noticeReset(Stamp now) {
  const std::optional<std::uint32_t> resets = body.devices.resets();
  if (resets && !body.belief.device_resets) body.belief.device_resets = resets;
  if (!resets || resets == body.belief.device_resets) return false;
  body.belief.device_resets = resets;
  body.base.resetOdometry();
  intake.forget();
  localization.carriedToStart(now);
  desk.control().onReset(now);
  return true;
}

void Robot::Impl::processPerception(Stamp now) {
  for (auto& result : intake.takeScans()) {
    localization.addMatch(result);
    intake.place(result, localization.tracked());
    reporting.telemetry().publish(result.cloud);
  }
  intake.tick();
  localization.update(now);
}

void Robot::Impl::updateBelief(Stamp now) {
  body.belief.X_map_base = localization.pose();
  body.belief.pose_stamp = now;
}

/// Said again each tick: an arena that was away hears it later.
void Robot::Impl::startArenaClock() {
  if (body.belief.clock_started && body.devices.arena != nullptr)
    (void)body.devices.arena->startClock();
}

/// A mission has begun, here or before a restart of the program.
void Robot::Impl::beginReport() {
  mission.beginReport();
  reporting.announceMission();
}

void Robot::Impl::updateReport() {
  if (mission.takeBegun()) beginReport();
  const TrackedPose& tracked = localization.tracked();
  mission.addTrack({tracked.stamp, tracked.X_map_base, body.base.tracking().X_odom_base,
                    localization.located(), localization.indoor(), body.belief.resets});
  mission.update();
}

GateSituation Robot::Impl::gateSituation(Stamp now) const {
  GateSituation found;
  const auto arm_state = body.devices.arm.state();
  found.protective_stop = arm_state && arm_state->safety == ArmSafetyMode::ProtectiveStop;
  const Twist2 moving = knownTwist(body.base.tracking().measured, body.devices.base.state(), now);
  found.base_moving = !(std::hypot(moving.vx_mps, moving.vy_mps) <= kStandstill_mps &&
                        std::abs(moving.wz_radps) <= kStandstill_radps);
  found.mission = &mission.info();
  found.ready = allOk(reporting.checks());
  found.not_ready_reason = firstFailure(reporting.checks());
  found.position_lost = localization.lostReason();
  found.view_age_s = std::min(ageOf(intake.perception().lastScan(), now).value_or(1e9),
                              ageOf(reporting.telemetry().lastPicture(), now).value_or(1e9));
  return found;
}

/// Makes what may fail. Nothing runs yet: what is refused leaves nothing behind.
Result<void> Robot::Impl::open(Executor& executor) {
  TelemetryHub& telemetry = reporting.telemetry();
  auto made = mission.make(
      {body.clock, executor, body.arena, body.robot, body.belief, body.drive, body.move_arm,
       body.devices.arm, body.pumps, body.pose, [this] { return intake.surroundings().scans(); },
       [this](Stamp stamp) { return intake.flangeAt(stamp, localization.tracked()); },
       [this](Stamp stamp) { return intake.bodyAt(stamp, localization.tracked()); },
       [&telemetry](const ThermalImagePtr& image) { telemetry.publish(image); },
       [&telemetry](MissionDetail detail) { telemetry.publish(std::move(detail)); }, &body.arm,
       body.devices.gripper, body.devices.storage});
  if (!made) return made;
  auto opened = desk.open(
      {[this](Stamp now) { return gateSituation(now); },
       [this](const Pose2& X_map_base) { localization.reset(X_map_base, body.clock.now()); }});
  if (!opened) return opened;
  return body.options.resume ? mission.resume() : Result<void>{};
}

void Robot::Impl::start(Executor& executor) {
  const Stamp now = body.clock.now();
  reporting.open();
  localization.reset(body.options.start_pose.value_or(body.arena.start.pose()), now);
  intake.start([this](ThermalImagePtr image) { mission.mission().onThermal(std::move(image)); },
               [this](const RgbImagePtr& image) {
                 if (image->frame == frames::kRgb) mission.mission().onPicture(image);
                 reporting.telemetry().onPicture(image);
               });
  executor.every(fromSeconds(1.0 / body.settings.arm.servo_rate_hz), "control", kPriorityControl,
                 [this](Stamp t) {
                   const auto wheels = body.devices.base.state();  // of which the odometry is made
                   body.tick(t);
                   intake.remember(wheels, body.base.tracking().X_odom_base);
                 });
  executor.every(kMissionPeriod, "mission", kPriorityMission, [this](Stamp t) { missionTick(t); });
  executor.every(kHealthPeriod, "health", kPriorityMission,
                 [this](Stamp t) { reporting.checkHealth(t); });
  if (body.options.resume) {
    beginReport();
    localization.reset(body.belief.X_map_base, now);
  } else if (body.options.start) {
    mission.host().waitForStart();
  }
}

Result<std::unique_ptr<Robot>> Robot::create(const RobotSettings& settings,
                                             const RobotOptions& options, Devices devices,
                                             const Clock& clock, Executor& executor,
                                             OperatorLink* link, StopLatch& stop) {
  auto robot = loadGeometry(settings.geometry);
  if (!robot) return tl::make_unexpected(robot.error());
  if (auto calibrated = calibratedGeometry(*robot, options); calibrated) {
    robot = std::move(calibrated);
  } else {
    return tl::make_unexpected(calibrated.error());
  }
  auto arena = loadArena(settings.arena);
  if (!arena) return tl::make_unexpected(arena.error());
  if (settings.flat_ground) arena->approach = {};
  auto fence = arenaFence(*arena, *robot, settings.drive_to.fence);
  if (!fence) return tl::make_unexpected(fence.error());
  auto location = makeLocation(settings.localization, *arena);
  if (!location) return tl::make_unexpected(location.error());
  auto impl =
      std::make_unique<Impl>(settings, options, std::move(devices), clock, executor, link, stop,
                             std::move(*robot), std::move(*arena), std::move(*location));
  impl->body.fence = std::make_shared<const Geofence>(std::move(*fence));
  impl->body.base.setGeofence(impl->body.fence);
  if (auto opened = impl->open(executor); !opened) return tl::make_unexpected(opened.error());
  impl->start(executor);
  return std::unique_ptr<Robot>(new Robot(std::move(impl)));
}

Robot::Robot(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Robot::~Robot() { impl_->intake.stop(); }

bool Robot::missionEnded() const { return impl_->mission.ended(); }
bool Robot::missionSucceeded() const { return impl_->mission.succeeded(); }
std::string Robot::reportJson(Stamp now) const { return impl_->mission.reportJson(now); }
const std::vector<float>& Robot::locateCosts() const { return impl_->localization.matchCosts(); }
const BaseController& Robot::base() const { return impl_->body.base; }
const PumpController& Robot::pumps() const { return impl_->body.pumps; }

}  // namespace kiln
