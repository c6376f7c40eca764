#include "robot/app/robot.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include <fmt/ranges.h>

#include "common/config/resources.h"
#include "common/core/log.h"
#include "common/robot_model/robot_calibration.h"
#include "robot/app/robot_impl.h"
#include "robot/skills/arena_fence.h"

namespace kiln {

namespace {

constexpr std::size_t kMostCosts = 100'000;  // scans: nearly three hours
constexpr Duration kFirstFix = std::chrono::seconds(3);
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

void warnIfFailed(const Result<void>& started) {
  if (!started) logger("robot")->error("{}", started.error().message);
}

Robot::Impl::Impl(const RobotSettings& settings_in, const RobotOptions& options_in,
                  Devices devices_in, const Clock& clock_in, Executor& executor,
                  OperatorLink* link_in, StopLatch& stop_in, RobotGeometry robot_in,
                  ArenaMap arena_in, const SprayCalibration& spray_in, std::vector<Macro> macros_in,
                  Location location)
    : settings(settings_in),
      options(options_in),
      devices(std::move(devices_in)),
      clock(clock_in),
      link(link_in),
      stop(stop_in),
      robot(std::move(robot_in)),
      arena(std::move(arena_in)),
      base(settings.base, robot, devices.base, stop),
      arm(settings.arm, robot, devices.arm, stop),
      pumps(settings.pumps, devices.pumps, stop),
      self_filter(robot, settings.self_filter),
      locator(std::move(location.locator)),
      map_layer(std::move(location.layer)),
      localizer(settings.localization.localizerConfig(), arena, robot),
      perception(settings.perception, executor, robot, history, self_filter, *locator,
                 settings.surroundings.obstacles),
      surroundings(settings.surroundings, fireBoxSizes(arena), executor),
      motion_watch(settings.motion_watch),
      drive(settings.drive_to, arena, base, [this] { return pose(); }),
      move_arm(settings.move_arm, robot, arena, arm, devices.arm, [this] { return pose(); }),
      spray(spray_in),
      macros(settings.macros,
             {robot, arena, move_arm, pumps, spray, [this] { return pose(); },
              [this] { return flange(); }, [this] { return authority.epoch().value(); }},
             std::move(macros_in)),
      teleop(settings.teleop, robot, arena, base, arm, pumps),
      authority(settings.authority),
      telemetry({10.0, 10.0, 5.0, 1.0, settings.camera_rate_hz, settings.jpeg_quality}, link,
                executor),
      health([this] { return mission->machine().blocked(); },
             [this](RobotStatus last) {
               if (link) link->publish(std::move(last));
             }),
      report(clock.now()) {
  belief.X_map_base = arena.start.pose();
}

Result<void> Robot::Impl::makeMission(Executor& executor) {
  const MissionKind* kind = findMission(options.mission);
  if (kind == nullptr)
    return makeError(ErrorCode::InvalidInput, "there is no mission '{}'; known: {}",
                     options.mission, fmt::join(missionNames(), ", "));
  auto made = kind->make(
      *settings.missions.find(kind->name), options.mission_uuid,
      {clock, executor, arena, robot, belief, drive, move_arm, devices.arm, pumps, spray,
       [this] { return pose(); }, surroundings, [this](Stamp stamp) { return flangeAt(stamp); },
       [this](const ThermalImagePtr& image) { telemetry.publish(image); },
       [this](HeatDetections found) { telemetry.publish(std::move(found)); }});
  if (!made) return tl::make_unexpected(made.error());
  mission = std::move(*made);
  host = std::make_unique<MissionHost>(
      *mission, belief, stop, clock,
      CheckpointKeeper::Config{checkpointPath(), settings.checkpoint_period_s});
  control = std::make_unique<MissionControl>(MissionControl::Parts{
      *host, authority, teleop, macros, alarms, stop, devices.arm, arm, devices.arena,
      [this] { return pose(); }, [this](Stamp now) { return gateSituation(now); },
      [this](const Pose2& X_map_base) {
        localizer.reset(X_map_base, clock.now());
        forgetMatch();
      },
      options.recorder ? [recorder = options.recorder](bool on) { recorder->set(on); }
                       : std::function<void(bool)>()});
  return {};
}

void Robot::Impl::start(Executor& executor) {
  const Stamp now = clock.now();
  limits = controllerLimits(settings, robot);
  log_sink = addLogSink([this](const LogRecord& record) { telemetry.onLog(record, clock.now()); });
  localizer.reset(options.start_pose.value_or(arena.start.pose()), now);
  drive.setSurroundings(&surroundings);
  move_arm.setSurroundings(&surroundings);
  if (devices.lidar)
    warnIfFailed(devices.lidar->start([this](PointCloudPtr scan) {
      if (options.recorder) options.recorder->scan(scan);
      perception.onScan(std::move(scan));
    }));
  if (devices.thermal)
    warnIfFailed(devices.thermal->start(
        [this](ThermalImagePtr image) { mission->onThermal(std::move(image)); }));
  executor.every(fromSeconds(1.0 / settings.arm.servo_rate_hz), "control", kPriorityControl,
                 [this](Stamp t) { controlTick(t); });
  executor.every(kMissionPeriod, "mission", kPriorityMission, [this](Stamp t) { missionTick(t); });
  executor.every(kHealthPeriod, "health", kPriorityMission, [this](Stamp t) { health.tick(t); });
  telemetry.publish(mission->machine().info());
  telemetry.publish(macros.list());
  if (map_layer) telemetry.publish(map_layer);
  if (options.resume) {
    beginReport();
    localizer.reset(belief.X_map_base, now);
  } else if (options.start) {
    host->waitForStart();
  }
}

Result<void> Robot::Impl::resume() {
  const std::string path = checkpointPath();
  const auto saved = loadCheckpoint(path);
  if (!saved) return tl::make_unexpected(saved.error());
  auto restored = host->restore(*saved, clock.now());
  if (!restored)
    return makeError(restored.error().code, "{}: {}; start without --resume", path,
                     restored.error().message);
  return {};
}

void Robot::Impl::controlTick(Stamp now) {
  base.tick(now);
  arm.tick(now);
  pumps.tick(now);
  const auto arm_state = devices.arm.state();
  if (arm_state) history.add({arm_state->stamp, arm_state->q, base.tracking().X_odom_base});
}

void Robot::Impl::missionTick(Stamp now) {
  readSensors(now);
  takePerception(now);
  watchPosition(now);
  watchMotion(now);
  obeyOperators(now);
  runChecks(now);
  belief.X_map_base = pose();
  belief.pose_stamp = now;
  host->goOnWhenAllowed(control->situation(now), now);
  control->step(now);
  updateReport();
  raiseAlarms(now);
  publish(now);
  record(now);
}

void Robot::Impl::readSensors(Stamp now) {
  const std::optional<std::uint32_t> resets = devices.resets();
  if (resets && !belief.device_resets) belief.device_resets = resets;
  if (resets && resets != belief.device_resets) {  // now, or while this program was dead
    belief.device_resets = resets;
    base.resetOdometry();
    history.clear();
    surroundings.clear();
    motion_watch.restart();
    localizer.reset(arena.start.pose(), now);
    forgetMatch();
    carried = now;
    control->onReset(now);
    return;  // the old odometry is still in the tracking of this instant
  }
  const BaseTracking tracking = base.tracking();
  // Also after a STOP: it may roll or be pushed, and the operator wants to know where it stands.
  const auto wheels = devices.base.state();
  const bool stopped_and_heard = tracking.stop_latched && wheels &&
                                 toSeconds(now - wheels->stamp) <= settings.base.max_state_age_s;
  if (tracking.ready || stopped_and_heard)
    localizer.addOdometry(tracking.stamp, tracking.X_odom_base);
  tracked = localizer.pose(now);
  perception.dispatch(now, localizer, !tracking.at_rest);
}

void Robot::Impl::takePerception(Stamp now) {
  for (auto& result : perception.takeScans()) {
    if (result.match) {
      noteMatch(*result.match, localizer.addResult(result.prior, *result.match));
      if (locate_s.size() < kMostCosts) locate_s.push_back(static_cast<float>(result.locate_s));
    }
    placeScan(result);
    telemetry.publish(result.cloud);
  }
  surroundings.tick(base.tracking().X_odom_base);
  tracked = localizer.pose(now);
}

std::optional<Eigen::Isometry3d> Robot::Impl::flangeAt(Stamp stamp) const {
  const auto sample = history.at(stamp);
  if (!sample) return std::nullopt;
  return toIsometry(tracked.X_map_odom * sample->X_odom_base) * robot.X_base_flange(sample->q);
}

std::string Robot::Impl::positionLost() const {
  return tracked.health == PoseHealth::Lost ? "position lost: " + tracked.reason : std::string();
}

/// A mission does not go on from a place that nobody knows. After a reset the first scans decide.
void Robot::Impl::watchPosition(Stamp now) {
  if (tracked.health != PoseHealth::Lost) carried.reset();
  if (tracked.health != PoseHealth::Lost || host->phase() != MissionPhase::Running) return;
  if (carried && now - *carried < kFirstFix) return;
  control->holdMission(HoldReason::PositionLost, positionLost(), now);
}

void Robot::Impl::placeScan(PerceptionJobs::ScanResult& result) {
  const auto sample = history.at(result.cloud->stamp);
  if (!sample || !result.obstacles) return;
  // Height and tilt are those of now, a tenth of a second later.
  const Eigen::Isometry3d X_plane_base =
      toIsometry(tracked.X_map_base).inverse() * tracked.X_map_base_3d;
  surroundings.add({result.cloud, std::move(*result.obstacles), sample->X_odom_base,
                    toIsometry(tracked.X_map_odom * sample->X_odom_base) * X_plane_base});
}

/// The base must do what it is told, and go where localisation says: else the software STOP.
void Robot::Impl::watchMotion(Stamp now) {
  if (options.environment == Environment::Replay) return;  // it moved then by commands of then
  const BaseTracking tracking = base.tracking();
  const bool located = tracked.health != PoseHealth::Lost;
  base.placeInMap(located ? std::optional(tracked.X_map_odom) : std::nullopt);
  if (!tracking.ready || stop.latched()) {
    motion_watch.restart();
    return;
  }
  const std::string wrong =
      motion_watch.step({tracking.stamp, tracking.commanded, tracking.measured,
                         tracking.X_odom_base, located ? std::optional(pose()) : std::nullopt});
  if (!wrong.empty()) (void)stop.set("motion watch: " + wrong, now);
}

GateSituation Robot::Impl::gateSituation(Stamp now) const {
  GateSituation found;
  const auto arm_state = devices.arm.state();
  found.protective_stop = arm_state && arm_state->safety == ArmSafetyMode::ProtectiveStop;
  const Twist2 moving = base.tracking().measured;
  found.base_moving = std::hypot(moving.vx_mps, moving.vy_mps) > kStandstill_mps ||
                      std::abs(moving.wz_radps) > kStandstill_radps;
  found.ready = allOk(checks);
  found.not_ready_reason = firstFailure(checks);
  found.position_lost = positionLost();
  found.view_age_s = std::min(ageOf(perception.lastScan(), now).value_or(1e9),
                              ageOf(telemetry.lastPicture(), now).value_or(1e9));
  return found;
}

void Robot::Impl::obeyOperators(Stamp now) {
  control->observeStop(now);
  if (!link) return;
  const Authority::Step step =
      authority.step(link->takeCommands(), link->operators(), *control, now);
  for (const CommandAck& ack : step.acks) link->acknowledge(ack);
  for (const std::string& event : step.events) operators_log.info("{}", event);
}

void Robot::Impl::runChecks(Stamp now) {
  lookAtDisk(now);
  const PreflightInputs found = preflightInputs(now);
  checks = preflight(found, settings.preflight);
  for (Check& check : mission->checks(now)) checks.push_back(std::move(check));
  late_product = lateProduct(found, settings.preflight);
}

/// A mission has begun, here or before a restart of the program.
void Robot::Impl::beginReport() {
  report.begin();
  ended.store(false);
  succeeded.store(false);
  const FsmInfo info = mission->machine().info();
  if (link) link->setMissionUuid(info.mission_uuid);
  telemetry.publish(info);
}

void Robot::Impl::updateReport() {
  const FsmStatus& fsm = host->fsm();
  if (host->starts() != starts_seen) {
    starts_seen = host->starts();
    beginReport();
  }
  if (belief.clock_started)
    (void)devices.arena.startClock();  // a world that is gone hears it later
  const BaseTracking tracking = base.tracking();
  report.addTrack({tracked.stamp, tracked.X_map_base, tracking.X_odom_base,
                   tracked.health != PoseHealth::Lost, localizer.submap() == Submap::Indoor,
                   belief.resets});
  if (fsm.terminal && !ended.load()) {
    succeeded.store(fsm.success);
    ended.store(true);
    logger("mission")->info("mission ended: {}", fsm.success ? "success" : fsm.display_text);
  }
}

Result<std::unique_ptr<Robot>> Robot::create(const RobotSettings& settings,
                                             const RobotOptions& options, Devices devices,
                                             const Clock& clock, Executor& executor,
                                             OperatorLink* link, StopLatch& stop) {
  auto robot = loadResource<RobotGeometry>(settings.geometry);
  if (!robot) return tl::make_unexpected(robot.error());
  if (auto calibrated = calibratedGeometry(*robot, options); calibrated) {
    robot = std::move(calibrated);
  } else {
    return tl::make_unexpected(calibrated.error());
  }
  auto arena = loadResource<ArenaMap>(settings.arena);
  if (!arena) return tl::make_unexpected(arena.error());
  if (settings.flat_ground) arena->approach = {};
  auto spray = loadResource<SprayCalibration>(settings.spray_calibration);
  if (!spray) return tl::make_unexpected(spray.error());
  if (auto valid = spray->validate(); !valid) return tl::make_unexpected(valid.error());
  auto folder = resourcePath("macros");
  if (!folder) return tl::make_unexpected(folder.error());
  auto macros = loadMacros(*folder);
  if (!macros) return tl::make_unexpected(macros.error());
  auto fence = arenaFence(*arena, *robot, settings.drive_to.fence);
  if (!fence) return tl::make_unexpected(fence.error());
  auto location = makeLocation(settings.localization, *arena);
  if (!location) return tl::make_unexpected(location.error());
  auto impl = std::make_unique<Impl>(settings, options, std::move(devices), clock, executor, link,
                                     stop, std::move(*robot), std::move(*arena), *spray,
                                     std::move(*macros), std::move(*location));
  impl->base.setGeofence(std::make_shared<const Geofence>(std::move(*fence)));
  if (auto made = impl->makeMission(executor); !made) return tl::make_unexpected(made.error());
  // Before anything runs: a checkpoint that is refused leaves nothing behind.
  if (options.resume) {
    if (auto resumed = impl->resume(); !resumed) return tl::make_unexpected(resumed.error());
  }
  impl->start(executor);
  return std::unique_ptr<Robot>(new Robot(std::move(impl)));
}

Robot::Robot(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Robot::~Robot() {
  if (impl_->devices.lidar) impl_->devices.lidar->stop();
  if (impl_->devices.thermal) impl_->devices.thermal->stop();
  if (impl_->devices.operator_camera) impl_->devices.operator_camera->stop();
}

bool Robot::missionEnded() const { return impl_->ended.load(); }
bool Robot::missionSucceeded() const { return impl_->succeeded.load(); }
std::string Robot::reportJson(Stamp now) const {
  return impl_->report.toJson(*impl_->host, impl_->belief.resets, now);
}
const std::vector<float>& Robot::locateCosts() const { return impl_->locate_s; }
const BaseController& Robot::base() const { return impl_->base; }
const PumpController& Robot::pumps() const { return impl_->pumps; }

}  // namespace kiln
