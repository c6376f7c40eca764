// What the robot tells of itself: status, scene, alarms.
#include <algorithm>

#include "common/geom/frames.h"
#include "robot/app/robot_impl.h"
#include "robot/app/standstill.h"

namespace kiln {

void Robot::Impl::raiseAlarms(Stamp now) {
  const FsmStatus& fsm = host->fsm();
  const auto arm_state = devices.arm.state();
  const bool protective = arm_state && arm_state->safety == ArmSafetyMode::ProtectiveStop;
  alarms.set("arm.protective_stop", protective, AlarmLevel::Warning, "Arm in protective stop",
             "look at the arm, then hold Release protective stop", now);
  alarms.set("devices.lost", !devices.connected(), AlarmLevel::Warning,
             "No connection to the robot's devices",
             "check power and kiln-sim; the robot stands still by itself", now);
  alarms.set("perception.late", fsm.running && !late_product.empty(), AlarmLevel::Warning,
             "Perception does not deliver: " + late_product,
             "the picture is old: do not steer by it; restart the daemon", now);
  const PumpTracking water = pumps.tracking();
  alarms.set("pumps.no_current", water.no_current, AlarmLevel::Caution, "A pump draws no current",
             "tank empty, hose blocked or cable loose: check, then spray again", now);
  alarms.set("pose.lost", fsm.running && tracked.health == PoseHealth::Lost, AlarmLevel::Warning,
             "Position lost", "drive by hand or call a reset", now);
  alarms.set("teleop.too_near", host->mode() == Mode::Teleop && !teleop.blocked().empty(),
             AlarmLevel::Advisory, "Arm jog stopped: " + teleop.blocked(), "jog away from it", now);
  const std::string fence = base.tracking().limited;
  alarms.set("base.fence", !fence.empty(), AlarmLevel::Advisory, "Base limited by the " + fence,
             "drive back into the arena", now);
  const auto storage = host->storageProblem();
  alarms.set("storage", storage.has_value(), AlarmLevel::Caution, storage ? storage->message : "",
             "The mission goes on but could not be resumed; free the disk", now);
  const std::string blocked = health.take();  // and it goes on again
  alarms.set("fsm.blocked", !blocked.empty(), AlarmLevel::Warning, blocked,
             "press STOP and restart the daemon", now);
  const auto base_state = devices.base.state();
  const double battery_v = base_state ? base_state->battery_v : 0.0;
  alarms.set("battery.low", battery_v > 1.0 && battery_v < settings.preflight.battery_min_v,
             AlarmLevel::Caution, "Battery low", "finish and change the battery", now);
  const std::string not_recording = options.recorder ? options.recorder->status().problem : "";
  alarms.set("recording", !not_recording.empty(), AlarmLevel::Caution,
             "Recording has ended: " + not_recording,
             "make room on the disk, then switch the recording on again", now);
  raiseMissionAlarms(now);
}

void Robot::Impl::raiseMissionAlarms(Stamp now) {
  std::vector<std::string> raised;
  for (const MissionAlarm& alarm : mission->alarms(now)) {
    alarms.set(alarm.id, true, alarm.level, alarm.text, alarm.action, now);
    raised.push_back(alarm.id);
  }
  for (const std::string& id : mission_alarms)
    if (std::find(raised.begin(), raised.end(), id) == raised.end())
      alarms.set(id, false, AlarmLevel::Advisory, "", "", now);
  mission_alarms = std::move(raised);
}

StopStatus Robot::Impl::stopStatus(Stamp now) const {
  StopStatus s;
  s.latched = stop.latched();
  s.source = stop.source();
  s.since = stop.since();
  s.generation = stop.generation();
  proveStandstill(s, devices.arm.state(), devices.base.state(), devices.pumps.state(), now);
  return s;
}

RobotStatus Robot::Impl::status(Stamp now) const {
  RobotStatus s;
  s.stamp = now;
  s.seq = status_seq;
  s.robot_name = settings.name;
  s.version = options.version;
  s.environment = options.environment;
  s.mode = host->mode();
  s.word = host->word(allOk(checks));
  s.reason = s.word == StatusWord::NotReady ? firstFailure(checks) : host->reason();
  s.phase = host->phase();
  s.holds = host->holds();
  s.checks = checks;
  s.lease = authority.lease(now);
  s.stop = stopStatus(now);
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
  mission->describe(s, now);
  s.macro = macros.status();
  if (options.recorder) s.recording = options.recorder->status();
  s.speed_scale = teleop.speedScale();
  s.mission_elapsed_s = belief.elapsedS(now);
  s.mission_limit_s = mission->limitS();
  s.resets = belief.resets;
  s.alarms = alarms.list();
  if (link) {
    s.drops = link->drops();
    for (const OperatorPeer& peer : link->operators()) s.operators.push_back(peer.name);
  }
  s.drops.push_back({"perception", perception.droppedFrames() + mission->droppedFrames()});
  if (options.recorder) s.drops.push_back({"recorder", s.recording.dropped});
  return s;
}

LocalizationStatus Robot::Impl::localizationStatus() const {
  LocalizationStatus s;
  s.stamp = tracked.stamp;
  s.health = tracked.health == PoseHealth::Good       ? LocalizationHealth::Good
             : tracked.health == PoseHealth::Degraded ? LocalizationHealth::Degraded
                                                      : LocalizationHealth::Lost;
  s.reason = tracked.reason;
  s.method = settings.localization.method;
  if (settings.localization.method == "surfel_map") s.submap = toString(localizer.submap());
  s.X_map_base = tracked.X_map_base_3d;
  s.X_map_odom = tracked.X_map_odom;
  s.covariance = tracked.covariance;
  s.sigma_m = tracked.sigma_m;
  s.sigma_yaw_rad = tracked.sigma_yaw_rad;
  s.match_age_s = tracked.age_s;
  s.inlier_fraction = tracked.inlier_fraction;
  s.observable_directions = tracked.observable_directions;
  s.matches = tracked.fixes;
  s.rejected = tracked.rejected;
  s.resets = static_cast<int>(belief.device_resets.value_or(0));
  return s;
}

Scene Robot::Impl::scene(Stamp now) const {
  Scene scene;
  scene.stamp = now;
  scene.planned = {now, drive.waypoints(), drive.nextIndex()};
  scene.arena = sceneBoxes(arena);
  mission->describe(scene, now);
  return scene;
}

/// Pictures cost the robot and the link more than everything else together: taken only while
/// somebody watches.
void Robot::Impl::runCameraOnDemand() {
  if (!devices.operator_camera || !link) return;
  if (options.recorder)
    link->keepPictures(options.recorder->config().pictures && options.recorder->on());
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
  if (telemetry.fsmDue(now, host->fsm().step)) telemetry.publish(host->fsm());
  if (telemetry.statusDue(now)) {
    ++status_seq;
    const RobotStatus told = status(now);
    health.remember(told);
    telemetry.publish(told);
  }
  if (telemetry.sceneDue(now)) telemetry.publish(scene(now));
  if (telemetry.localizationDue(now)) telemetry.publish(localizationStatus());
  if (tracked.health != PoseHealth::Lost)
    driven_grew |=
        driven.add(now, tracked.X_map_base, static_cast<int>(belief.device_resets.value_or(0)));
  if (driven_grew && telemetry.trajectoryDue(now)) {
    telemetry.publish(driven.trajectory());
    driven_grew = false;
  }
  telemetry.flushLog(now);
}

}  // namespace kiln
