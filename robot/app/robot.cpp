#include "robot/app/robot.h"

#include <atomic>
#include <cmath>

#include "common/config/resources.h"
#include "common/core/log.h"
#include "common/geom/frames.h"
#include "robot/app/heat_localizer_sweep.h"
#include "robot/app/mission_control.h"
#include "robot/app/mission_report.h"
#include "robot/app/telemetry_hub.h"
#include "robot/safety/authority.h"

namespace kiln {
namespace {

constexpr Duration kMissionPeriod = std::chrono::milliseconds(20);
constexpr double kRest_radps = 0.02;  ///< joints and wheels below this stand still
constexpr double kPumpRest_a = 0.3;

std::optional<double> age(const std::optional<Stamp>& stamp, Stamp now) {
  return stamp ? std::optional(toSeconds(now - *stamp)) : std::nullopt;
}

template <class T>
std::optional<Stamp> stampOf(const std::optional<T>& state) {
  return state ? std::optional(state->stamp) : std::nullopt;
}

/// Rules of Challenge 3: 6 points for the first litre on the burning place. What is burning is
/// known by what was sprayed at, and litres are an estimate.
double scoreEstimate(const WorldState& world) {
  double best_l = 0.0;
  for (const FirePlace& place : world.places) best_l = std::max(best_l, place.litres_est);
  return 6.0 * std::min(best_l, 1.0);
}

template <class T>
Result<T> loadResource(const std::string& resource) {
  T config;
  auto file = resourcePath(resource);
  if (!file) return tl::make_unexpected(file.error());
  if (auto loaded = loadConfig(*file, config); !loaded) return tl::make_unexpected(loaded.error());
  return config;
}

void warnIfFailed(const Result<void>& started) {
  if (!started) logger("robot")->error("{}", started.error().message);
}

}  // namespace

struct Robot::Impl {
  Impl(const RobotSettings& settings_in, const RobotOptions& options_in, Devices devices_in,
       const Clock& clock_in, Executor& executor, OperatorLink* link_in, StopLatch& stop_in,
       RobotGeometry robot_in, ArenaMap arena_in, const SprayCalibration& spray_in,
       std::vector<Macro> macros_in);
  void start(Executor& executor);
  void controlTick(Stamp now);
  void missionTick(Stamp now);

  void readSensors(Stamp now);
  void takePerception(Stamp now);
  void obeyOperators(Stamp now);
  void startWhenReady(Stamp now);
  void keepBooks(Stamp now);
  void recordEstimate(Stamp image, const Eigen::Isometry3d& X_map_thermal);
  void raiseAlarms(Stamp now);
  void publish(Stamp now);
  void runCameraOnDemand();
  [[nodiscard]] RobotStatus status(Stamp now) const;
  [[nodiscard]] Scene scene(Stamp now) const;
  [[nodiscard]] PreflightInputs preflightInputs(Stamp now) const;
  [[nodiscard]] bool atStandstill() const;
  [[nodiscard]] Pose2 pose() const { return tracked.X_map_base; }
  [[nodiscard]] std::string checkpointPath() const {
    return options.state_dir.empty() ? std::string()
                                     : options.state_dir + "/" + options.mission + ".checkpoint";
  }
  [[nodiscard]] std::optional<Eigen::Isometry3d> flange() const {
    const auto state = devices.arm.state();
    return state ? std::optional(robot.X_base_flange(state->q)) : std::nullopt;
  }
  Result<void> resume(Stamp now);

  RobotSettings settings;
  RobotOptions options;
  Devices devices;
  const Clock& clock;
  OperatorLink* link;
  StopLatch& stop;
  RobotGeometry robot;
  ArenaMap arena;

  BaseController base;
  ArmController arm;
  PumpController pumps;
  StateHistory history;
  SelfFilter self_filter;
  BoxMapAligner aligner;
  HeatDetector detector;
  PoseTracker tracker;
  TrackedPose tracked;
  PerceptionJobs perception;
  DriveTo drive;
  MoveArm move_arm;
  WorldModel world;
  HeatLocalizerSweep sweep;
  FireMission mission;
  MacroRunner macros;
  Teleop teleop;
  AlarmBook alarms;
  Authority authority;
  MissionControl control;
  TelemetryHub telemetry;
  MissionReport report;
  LogSinkHandle log_sink;

  std::vector<Check> checks;
  FsmStatus fsm;
  std::optional<HeatDetections> last_heat;
  std::uint32_t resets_seen = 0;
  std::optional<Stamp> mission_start;
  std::uint64_t status_seq = 0;
  bool storage_ok = true;
  bool resume_pending = false;
  bool camera_runs = false;
  std::atomic<bool> ended{false}, succeeded{false};
};

Robot::Impl::Impl(const RobotSettings& settings_in, const RobotOptions& options_in,
                  Devices devices_in, const Clock& clock_in, Executor& executor,
                  OperatorLink* link_in, StopLatch& stop_in, RobotGeometry robot_in,
                  ArenaMap arena_in, const SprayCalibration& spray_in, std::vector<Macro> macros_in)
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
      aligner(settings.aligner, arena),
      detector(settings.heat_detector),
      tracker(settings.pose),
      perception(settings.perception, executor, robot, history, self_filter, aligner, detector,
                 settings.heat_detector.modelled_latency_s),
      drive(settings.drive_to, arena, base, [this] { return pose(); }),
      move_arm(settings.move_arm, robot, arena, arm, devices.arm, [this] { return pose(); }),
      world(initialWorld(arena)),
      sweep(settings.heat_localizer),
      mission({clock, arena, robot, world, drive, move_arm, devices.arm, pumps, sweep,
               [this] { return pose(); }},
              settings.fire, spray_in, {options.mission_uuid, checkpointPath()}),
      macros(settings.macros,
             {robot, arena, move_arm, pumps, spray_in, [this] { return pose(); },
              [this] { return flange(); }, [this] { return authority.epoch().value(); }},
             std::move(macros_in)),
      teleop(settings.teleop, robot, arena, base, arm, pumps),
      authority(settings.authority),
      control({mission, teleop, macros, alarms, stop, devices.arm, arm, devices.arena,
               [this] { return pose(); }}),
      telemetry({10.0, 10.0, 5.0, settings.camera_rate_hz, settings.jpeg_quality}, link, executor),
      report(options.mission, clock.now()) {}

void Robot::Impl::start(Executor& executor) {
  const Stamp now = clock.now();
  log_sink = addLogSink([this](const LogRecord& record) { telemetry.onLog(record, clock.now()); });
  tracker.reset(arena.start.pose(), now);
  resets_seen = devices.resets();
  if (devices.lidar)
    warnIfFailed(
        devices.lidar->start([this](PointCloudPtr scan) { perception.onScan(std::move(scan)); }));
  if (devices.thermal)
    warnIfFailed(devices.thermal->start(
        [this](ThermalImagePtr image) { perception.onThermal(std::move(image)); }));
  executor.every(fromSeconds(1.0 / settings.arm.servo_rate_hz), "control", kPriorityControl,
                 [this](Stamp t) { controlTick(t); });
  executor.every(kMissionPeriod, "mission", kPriorityMission, [this](Stamp t) { missionTick(t); });
  telemetry.publish(mission.machine().info());
  telemetry.publish(macros.list());
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
  obeyOperators(now);
  startWhenReady(now);
  control.step(now, authority.held(HoldKind::Macro, now));
  keepBooks(now);
  raiseAlarms(now);
  publish(now);
}

void Robot::Impl::readSensors(Stamp now) {
  if (devices.resets() != resets_seen) {
    resets_seen = devices.resets();
    base.resetOdometry();
    history.clear();
    tracker.reset(arena.start.pose(), now);
    control.onReset(now);
    return;  // the old odometry is still in the tracking of this instant
  }
  const BaseTracking tracking = base.tracking();
  if (tracking.ready) tracker.addOdometry(tracking.stamp, tracking.X_odom_base);
  tracked = tracker.pose(now);
  perception.dispatch(now, tracker, !tracking.at_rest);
}

void Robot::Impl::takePerception(Stamp now) {
  for (auto& result : perception.takeScans()) {
    if (result.fix) {
      if (*result.fix) {
        (void)tracker.addFix(result.prior, **result.fix);
      } else {
        tracker.addFailure(result.prior);
      }
    }
    telemetry.publish(result.cloud);
  }
  for (auto& result : perception.takeHeat()) {
    const auto sample = history.at(result.image->stamp);
    if (sample) {
      const Eigen::Isometry3d X_map_thermal = toIsometry(tracked.X_map_odom * sample->X_odom_base) *
                                              robot.X_base_flange(sample->q) *
                                              robot.X_flange_thermal.pose();
      mission.onDetections(result.detections, X_map_thermal);
      recordEstimate(result.detections.stamp, X_map_thermal);
    }
    last_heat = result.detections;
    telemetry.publish(result.image);
    telemetry.publish(std::move(result.detections));
  }
  tracked = tracker.pose(now);
}

void Robot::Impl::obeyOperators(Stamp now) {
  control.watchStop(now);
  if (!link) return;
  GateSituation situation;
  situation.mode = control.mode();
  situation.stop_latched = stop.latched();
  const auto arm_state = devices.arm.state();
  situation.protective_stop = arm_state && arm_state->safety == ArmSafetyMode::ProtectiveStop;
  situation.mission_running = fsm.running;
  situation.mission_paused = fsm.paused;
  situation.ready = allOk(checks);
  situation.not_ready_reason = firstFailure(checks);
  situation.view_age_s = std::min(age(perception.lastScan(), now).value_or(1e9),
                                  age(telemetry.lastPicture(), now).value_or(1e9));
  Authority::Step step =
      authority.step(link->takeCommands(), link->operators(), link->takeStops(), situation, now);
  control.onReleased(step.released, now);
  if (step.lease_lost) control.onLeaseLost(now);
  for (const CommandAck& ack : step.acks) link->acknowledge(ack);
  for (const std::string& event : step.events) logger("operators")->info("{}", event);
  for (const Authority::Accepted& accepted : step.accepted) {
    if (auto ack = control.execute(accepted, now)) link->acknowledge(*ack);
  }
}

void Robot::Impl::startWhenReady(Stamp now) {
  checks = preflight(preflightInputs(now), settings.preflight);
  if (resume_pending && allOk(checks)) {
    resume_pending = false;
    control.resumeMission(now);
  }
  if (!options.start || mission_start || !allOk(checks)) return;
  control.startMission(now);
}

void Robot::Impl::keepBooks(Stamp now) {
  fsm = mission.machine().status(now);
  if (fsm.running && !mission_start) {
    mission_start = now;
    report = MissionReport(options.mission, now);
  }
  report.observe(fsm);
  report.setTotals(world.state().sprayed_l_est, world.state().resets);
  if (fsm.terminal && !ended.load()) {
    succeeded.store(fsm.success);
    ended.store(true);
    logger("mission")->info("mission ended: {}", fsm.success ? "success" : fsm.display_text);
  }
}

void Robot::Impl::recordEstimate(Stamp image, const Eigen::Isometry3d& X_map_thermal) {
  const auto estimate = sweep.estimate();
  if (!estimate || estimate->stamp != image) return;
  report.addHeatEstimate({image, X_map_thermal.inverse() * estimate->p_map, estimate->range_m,
                          estimate->baseline_range_m, estimate->views, estimate->place});
}

void Robot::Impl::raiseAlarms(Stamp now) {
  const auto arm_state = devices.arm.state();
  const bool protective = arm_state && arm_state->safety == ArmSafetyMode::ProtectiveStop;
  alarms.set("arm.protective_stop", protective, AlarmLevel::Warning, "Arm in protective stop",
             "look at the arm, then hold Release protective stop", now);
  alarms.set("devices.lost", !devices.connected(), AlarmLevel::Warning,
             "No connection to the robot's devices",
             "check power and kiln-sim; the robot stands still by itself", now);
  const PumpTracking water = pumps.tracking();
  alarms.set("pumps.no_current", water.no_current, AlarmLevel::Caution, "A pump draws no current",
             "tank empty, hose blocked or cable loose: check, then spray again", now);
  alarms.set("pose.lost", fsm.running && tracked.health == PoseHealth::Lost, AlarmLevel::Warning,
             "Position lost", "drive by hand or call a reset", now);
  alarms.set("teleop.too_near", control.mode() == Mode::Teleop && !teleop.blocked().empty(),
             AlarmLevel::Advisory, "Arm jog stopped: " + teleop.blocked(), "jog away from it", now);
  const auto mission_alarms = mission.alarms();
  storage_ok = mission_alarms.empty();
  alarms.set("storage", !storage_ok, AlarmLevel::Caution,
             storage_ok ? "" : mission_alarms.front().text,
             storage_ok ? "" : mission_alarms.front().action, now);
  alarms.set("fsm.blocked", !fsm.blocked.empty(), AlarmLevel::Warning, fsm.blocked,
             "press STOP and restart the daemon", now);
  alarms.set("battery.low",
             preflightInputs(now).battery_v > 1.0 &&
                 preflightInputs(now).battery_v < settings.preflight.battery_min_v,
             AlarmLevel::Caution, "Battery low", "finish and change the battery", now);
}

bool Robot::Impl::atStandstill() const {
  const auto arm_state = devices.arm.state();
  const auto base_state = devices.base.state();
  const auto pump_state = devices.pumps.state();
  if (!arm_state || !base_state || !pump_state) return false;
  if (arm_state->qd.cwiseAbs().maxCoeff() > kRest_radps) return false;
  for (const WheelState& wheel : base_state->wheels) {
    if (std::abs(wheel.drive_radps) > kRest_radps * 5) return false;
  }
  return pump_state->current_a[0] < kPumpRest_a && pump_state->current_a[1] < kPumpRest_a;
}

PreflightInputs Robot::Impl::preflightInputs(Stamp now) const {
  PreflightInputs in;
  const auto arm_state = devices.arm.state();
  const auto base_state = devices.base.state();
  in.devices_connected = devices.connected();
  in.arm_age_s = age(stampOf(arm_state), now);
  in.base_age_s = age(stampOf(base_state), now);
  in.pumps_age_s = age(stampOf(devices.pumps.state()), now);
  in.lidar_age_s = age(perception.lastScan(), now);
  in.thermal_age_s = age(perception.lastThermal(), now);
  if (arm_state) in.arm_safety = arm_state->safety;
  if (base_state) in.battery_v = base_state->battery_v;
  if (last_heat && !last_heat->usable && !last_heat->blobs.empty()) in.thermal_usable = false;
  in.pose_health = tracked.health;
  in.storage_ok = storage_ok;
  return in;
}

RobotStatus Robot::Impl::status(Stamp now) const {
  RobotStatus s;
  s.stamp = now;
  s.seq = status_seq;
  s.robot_name = settings.name;
  s.version = options.version;
  s.environment = options.environment;
  s.mode = control.mode();
  s.word = control.word(now, allOk(checks));
  s.reason = s.word == StatusWord::NotReady ? firstFailure(checks) : control.reason();
  s.checks = checks;
  s.lease = authority.lease(now);
  s.stop = {stop.latched(), stop.source(), stop.since(), stop.latched() && atStandstill()};
  s.X_map_base = pose();
  s.pose_age_s = tracked.age_s;
  s.twist = base.tracking().measured;
  if (const auto arm_state = devices.arm.state()) {
    s.arm = *arm_state;
    s.X_base_nozzle = robot.X_base_flange(arm_state->q) * robot.X_flange_nozzle.pose();
  }
  if (const auto base_state = devices.base.state()) {
    for (std::size_t i = 0; i < 4; ++i) s.wheel_steer_rad[i] = base_state->wheels[i].steer_rad;
    s.battery_v = base_state->battery_v;
    s.battery_a = base_state->battery_a;
  }
  const PumpTracking water = pumps.tracking();
  s.water = {water.duty, water.current_a, water.tank_l_est, water.sprayed_l_est};
  s.macro = macros.status();
  s.speed_scale = teleop.speedScale();
  s.mission_elapsed_s = world.state().elapsedS(now);
  s.mission_limit_s = settings.mission_limit_s;
  s.resets = world.state().resets;
  s.score_est = scoreEstimate(world.state());
  s.alarms = alarms.list();
  if (link) {
    s.drops = link->drops();
    for (const OperatorPeer& peer : link->operators()) s.operators.push_back(peer.name);
  }
  s.drops.push_back({"perception", perception.droppedFrames()});
  return s;
}

Scene Robot::Impl::scene(Stamp now) const {
  Scene scene;
  scene.stamp = now;
  scene.fires = mission.fires();
  scene.places = mission.places();
  scene.planned = {now, drive.waypoints(), drive.nextIndex()};
  scene.jet = mission.jetPreview(now);
  scene.arena = sceneBoxes(arena);
  return scene;
}

/// Pictures cost the robot and the link more than everything else together: taken only while
/// somebody watches.
void Robot::Impl::runCameraOnDemand() {
  if (!devices.operator_camera || !link) return;
  const bool wanted = link->wanted(frames::kOperatorCamera);
  if (wanted == camera_runs) return;
  camera_runs = wanted;
  if (wanted) {
    warnIfFailed(devices.operator_camera->start(
        [this](RgbImagePtr image) { telemetry.onPicture(std::move(image)); }));
  } else {
    devices.operator_camera->stop();
  }
}

void Robot::Impl::publish(Stamp now) {
  runCameraOnDemand();
  if (telemetry.fsmDue(now, fsm.step)) telemetry.publish(fsm);
  if (telemetry.statusDue(now)) {
    ++status_seq;
    telemetry.publish(status(now));
  }
  if (telemetry.sceneDue(now)) telemetry.publish(scene(now));
  telemetry.flushLog(now);
}

Result<void> Robot::Impl::resume(Stamp now) {
  if (auto resumed = mission.resumeFrom(checkpointPath(), now); !resumed) return resumed;
  mission_start = now;
  tracker.reset(world.state().X_map_base, now);
  mission.machine().pause("resuming: waiting for sensors and position", now);
  resume_pending = true;
  return {};
}

Result<std::unique_ptr<Robot>> Robot::create(const RobotSettings& settings,
                                             const RobotOptions& options, Devices devices,
                                             const Clock& clock, Executor& executor,
                                             OperatorLink* link, StopLatch& stop) {
  auto robot = loadResource<RobotGeometry>(settings.geometry);
  if (!robot) return tl::make_unexpected(robot.error());
  auto arena = loadResource<ArenaMap>(settings.arena);
  if (!arena) return tl::make_unexpected(arena.error());
  auto spray = loadResource<SprayCalibration>(settings.spray_calibration);
  if (!spray) return tl::make_unexpected(spray.error());
  if (auto valid = spray->validate(); !valid) return tl::make_unexpected(valid.error());
  auto folder = resourcePath("macros");
  if (!folder) return tl::make_unexpected(folder.error());
  auto macros = loadMacros(*folder);
  if (!macros) return tl::make_unexpected(macros.error());
  auto impl =
      std::make_unique<Impl>(settings, options, std::move(devices), clock, executor, link, stop,
                             std::move(*robot), std::move(*arena), *spray, std::move(*macros));
  impl->start(executor);
  if (options.resume) {
    if (auto resumed = impl->resume(clock.now()); !resumed)
      return tl::make_unexpected(resumed.error());
  }
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
std::string Robot::reportJson(Stamp now) const { return impl_->report.toJson(now); }
const BaseController& Robot::base() const { return impl_->base; }
const PumpController& Robot::pumps() const { return impl_->pumps; }

}  // namespace kiln
