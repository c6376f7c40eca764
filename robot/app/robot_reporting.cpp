// What the robot tells of itself: status, scene, alarms.
#include "robot/app/robot_reporting.h"

#include <algorithm>

#include "common/geom/frames.h"
#include "robot/app/standing_alarms.h"
#include "robot/app/standstill.h"

namespace kiln {
RobotReporting::RobotReporting(Parts parts, Executor& executor)
    : parts_(parts),
      body_(parts.body),
      telemetry_({10.0, 10.0, 5.0, 1.0, body_.settings.camera_rate_hz, body_.settings.jpeg_quality},
                 parts.link, executor),
      health_([this] { return parts_.mission.mission().machine().blocked(); },
              [this](RobotStatus last) {
                if (parts_.link) parts_.link->publish(std::move(last));
              }) {}

void RobotReporting::open() {
  limits_ = controllerLimits(body_.settings, body_.robot);
  log_sink_ =
      addLogSink([this](const LogRecord& record) { telemetry_.onLog(record, body_.clock.now()); });
  telemetry_.publish(parts_.mission.mission().machine().info());
  telemetry_.publish(parts_.mission.info());
  telemetry_.publish(parts_.desk.macros().list());
  if (parts_.localization.mapLayer()) telemetry_.publish(parts_.localization.mapLayer());
}

void RobotReporting::announceMission() {
  const FsmInfo info = parts_.mission.mission().machine().info();
  if (parts_.link) parts_.link->setMissionUuid(info.mission_uuid);
  telemetry_.publish(info);
}

void RobotReporting::raiseAlarms(Stamp now) {
  AlarmBook& alarms = parts_.desk.alarms();
  const MissionHost& host = parts_.mission.host();
  const FsmStatus& fsm = host.fsm();
  const auto arm_state = body_.devices.arm.state();
  const bool protective = arm_state && arm_state->safety == ArmSafetyMode::ProtectiveStop;
  alarms.set("arm.protective_stop", protective, AlarmLevel::Warning, "Arm in protective stop",
             "look at the arm, then hold Release protective stop", now);
  alarms.set("devices.lost", !body_.devices.connected(), AlarmLevel::Warning,
             "No connection to the robot's devices",
             "check power and kiln-sim; the robot stands still by itself", now);
  setLidarAlarm(alarms, silent_lidar_, now);
  setMotionWatchAlarm(alarms, body_.stop, now);
  alarms.set("perception.late", fsm.running && !late_product_.empty(), AlarmLevel::Warning,
             "Perception does not deliver: " + late_product_,
             "the picture is old: do not steer by it; restart the daemon", now);
  const bool no_current = body_.pumps.tracking().no_current;
  alarms.set("pumps.no_current", no_current, AlarmLevel::Caution, "A pump draws no current",
             "tank empty, hose blocked or cable loose: check, then spray again", now);
  alarms.set("pose.lost", fsm.running && !parts_.localization.located(), AlarmLevel::Warning,
             "Position lost", "drive by hand or call a reset", now);
  alarms.set("teleop.too_near",
             host.mode() == Mode::Teleop && !parts_.desk.teleop().blocked().empty(),
             AlarmLevel::Advisory, "Arm jog stopped: " + parts_.desk.teleop().blocked(),
             "jog away from it", now);
  const std::string fence = body_.base.tracking().limited;
  alarms.set("base.fence", !fence.empty(), AlarmLevel::Advisory, "Base limited by the " + fence,
             "drive back into the arena", now);
  const auto storage = host.storageProblem();
  alarms.set("storage", storage.has_value(), AlarmLevel::Caution, storage ? storage->message : "",
             "The mission goes on but could not be resumed; free the disk", now);
  const std::string blocked = health_.take();  // and it goes on again
  alarms.set("fsm.blocked", !blocked.empty(), AlarmLevel::Warning, blocked,
             "press STOP and restart the daemon", now);
  const auto base_state = body_.devices.base.state();
  const double battery_v = base_state ? base_state->battery_v : 0.0;
  alarms.set("battery.low", battery_v > 1.0 && battery_v < body_.settings.preflight.battery_min_v,
             AlarmLevel::Caution, "Battery low", "finish and change the battery", now);
  const std::string not_recording =
      body_.options.recorder ? body_.options.recorder->status().problem : "";
  alarms.set("recording", !not_recording.empty(), AlarmLevel::Caution,
             "Recording has ended: " + not_recording,
             "make room on the disk, then switch the recording on again", now);
  raiseMissionAlarms(now);
}

void RobotReporting::raiseMissionAlarms(Stamp now) {
  AlarmBook& alarms = parts_.desk.alarms();
  std::vector<std::string> raised;
  for (const MissionAlarm& alarm : parts_.mission.mission().alarms(now)) {
    alarms.set(alarm.id, true, alarm.level, alarm.text, alarm.action, now);
    raised.push_back(alarm.id);
  }
  for (const std::string& id : mission_alarms_)
    if (std::find(raised.begin(), raised.end(), id) == raised.end())
      alarms.set(id, false, AlarmLevel::Advisory, "", "", now);
  mission_alarms_ = std::move(raised);
}

RobotStatus RobotReporting::status(Stamp now) const {
  const auto arm_state = body_.devices.arm.state();
  const auto base_state = body_.devices.base.state();
  PumpsState none;  // at rest
  none.stamp = now;
  RobotStatus s = parts_.desk.control().status(body_.belief, checks_, now);
  s.seq = status_seq_;
  s.robot_name = body_.settings.name;
  s.version = body_.options.version;
  s.environment = body_.options.environment;
  if (s.word == StatusWord::Auto) s.reason = silent_device_;
  proveStandstill(s.stop, arm_state, base_state,
                  body_.devices.pumps ? body_.pump_device.state() : std::optional(none), now);
  s.X_map_base = parts_.localization.pose();
  s.pose_age_s = parts_.localization.tracked().age_s;
  s.twist = knownTwist(body_.base.tracking().measured, base_state, now);
  if (arm_state) s.arm = *arm_state;
  if (base_state) {
    for (std::size_t i = 0; i < 4; ++i) s.wheel_steer_rad[i] = base_state->wheels[i].steer_rad;
  }
  s.battery_v = knownOf(base_state, &BaseState::battery_v, now);
  s.battery_a = knownOf(base_state, &BaseState::battery_a, now);
  if (body_.options.recorder) s.recording = body_.options.recorder->status();
  if (parts_.link) {
    s.drops = parts_.link->drops();
    for (const OperatorPeer& peer : parts_.link->operators()) s.operators.push_back(peer.name);
  }
  s.drops.push_back({"perception", parts_.intake.perception().droppedFrames() +
                                       parts_.mission.mission().droppedFrames()});
  if (body_.options.recorder) s.drops.push_back({"recorder", s.recording.dropped});
  return s;
}

Scene RobotReporting::scene(Stamp now) const {
  Scene scene;
  scene.stamp = now;
  scene.planned = {now, body_.drive.waypoints(), body_.drive.nextIndex()};
  scene.arena = sceneBoxes(body_.arena);
  parts_.mission.mission().describe(scene, now);
  return scene;
}

void RobotReporting::publish(Stamp now) {
  parts_.intake.runCameraOnDemand(parts_.link, parts_.mission.mission().wantsHeadCamera());
  const MissionHost& host = parts_.mission.host();
  if (telemetry_.fsmDue(now, host.fsm().step)) telemetry_.publish(host.fsm());
  if (telemetry_.statusDue(now)) {
    ++status_seq_;
    const RobotStatus told = status(now);
    health_.remember(told);
    telemetry_.publish(told);
  }
  if (telemetry_.sceneDue(now)) telemetry_.publish(scene(now));
  if (telemetry_.localizationDue(now)) telemetry_.publish(parts_.localization.status());
  if (parts_.localization.located())
    driven_grew_ |= driven_.add(now, parts_.localization.pose(),
                                static_cast<int>(body_.belief.device_resets.value_or(0)));
  if (driven_grew_ && telemetry_.trajectoryDue(now)) {
    telemetry_.publish(driven_.trajectory());
    driven_grew_ = false;
  }
  telemetry_.flushLog(now);
}

}  // namespace kiln
