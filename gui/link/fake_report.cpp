#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "common/wire/fire/codec/fire_codec.h"
#include "common/wire/fire/fire_view.h"
#include "gui/link/fake_robot.h"

/// What the fake robot tells: status, state, scene, macros.
namespace kiln::gui {

std::vector<GuardStatus> FakeRobot::guards() const {
  const double t = inStateS();
  const double tick = std::fmod(toSeconds(now_), 0.1);
  if (state_ == "EnterBuilding" || state_ == "DriveToLocation") {
    const Pose2 to = goal();
    const double left = std::hypot(to.x_m - pose_.x_m, to.y_m - pose_.y_m);
    return {{"Localised", true, "2 cm", tick},
            {"Path clear", true, "1.4 m", tick},
            {"At the way-point", left < 0.05, fmt::format("{:.2f} m to go", left), tick}};
  }
  if (state_ == "ArmSearch") {
    const double share = std::min(1.0, t / 10.0);
    return {{"Thermal image fresh", true, "8.8 Hz", 0.11},
            {"Sweep finished", share >= 1.0, fmt::format("{:.0f} %", 100 * share), tick},
            {"Heat source above 80 °C", hotSpot().u >= 0 && hotSpot().peak_c > 80,
             fmt::format("{:.0f} °C", hotSpot().u >= 0 ? hotSpot().peak_c : 24.0), 0.11}};
  }
  if (state_ == "AimHose") {
    const double error_cm = std::max(1.8, 9.0 - t);
    return {{"Heat source seen", true, "", 0.11},
            {"Estimate within 3 cm", error_cm < 3.0, fmt::format("{:.1f} cm", error_cm), 0.11},
            {"Arm at spray pose", t > 11.0,
             fmt::format("{:.2f} m to go", std::max(0.0, 0.5 - t * 0.045)), tick},
            {"Pump ready", true, "", 0.042}};
  }
  if (state_ == "SpraySteady" || state_ == "SprayPattern") {
    return {{"Pump current", true, "2.1 A", 0.04},
            {"Jet on the plate", true, "", 0.11},
            {"Phase complete", false, fmt::format("{:.2f} l", sprayed_l_), tick}};
  }
  if (state_ == "WaitForStart") return {{"Operator starts", false, "waiting for you", -1}};
  return {};
}

FsmStatus FakeRobot::fsmStatus() const {
  FsmStatus s;
  s.stamp = now_;
  s.mission_uuid = info_.mission_uuid;
  s.step = step_;
  s.state = state_;
  s.entered = entered_;
  s.running = running_;
  s.paused = paused_ || mode_ == Mode::Teleop;
  s.terminal = terminal_;
  s.success = success_;
  s.guards = guards();
  s.history.assign(history_.begin(), history_.end());
  if (state_ == "AimHose")
    s.display_text =
        fmt::format("step {} of 5", std::min(5, 1 + static_cast<int>(inStateS() / 2.8)));
  if (state_ == "DriveToLocation" || state_ == "ArmSearch")
    s.display_text = at_ < 5 ? "place 1" : "place 2";
  if (state_ == "MissionDone") s.display_text = fmt::format("{:.2f} l sprayed (est.)", sprayed_l_);
  return s;
}

RobotStatus FakeRobot::status() const {
  RobotStatus s;
  s.stamp = now_;
  s.version = "fake";
  s.mode = stopped_ ? Mode::Stopped : mode_;
  s.word = stopped_                    ? StatusWord::Stopped
           : mode_ == Mode::Teleop     ? StatusWord::Teleop
           : paused_                   ? StatusWord::Paused
           : !running_ && checks_fail_ ? StatusWord::NotReady
           : !running_                 ? StatusWord::Ready
           : mode_ == Mode::Supervised ? StatusWord::Supervised
                                       : StatusWord::Auto;
  if (stopped_) s.reason = stop_source_;
  if (paused_) s.reason = "by operator";
  if (s.word == StatusWord::NotReady) s.reason = "LiDAR: no scan for 2.1 s";
  s.checks = checks();
  s.lease.holder_client = holder_;
  s.lease.holder_name = holder_name_;
  s.lease.epoch = holder_.empty() ? 0 : epoch_;
  s.lease.expires_in_s = holder_.empty() ? 0.0 : 2.0;
  s.stop.latched = stopped_;
  s.stop.source = stop_source_;
  s.stop.since = stop_since_;
  s.stop.standstill_proven = stopped_ && toSeconds(now_ - stop_since_) > 0.5;
  s.stop.base_at_rest = s.stop.arm_at_rest = s.stop.pumps_at_rest = s.stop.standstill_proven;
  s.X_map_base = pose_;
  s.pose_age_s = 0.06;
  s.twist = jog_;
  s.arm.stamp = now_;
  s.arm.q = q_;
  const double t = toSeconds(now_);
  s.arm.wrench_tool[0] = 6.0 + 2.0 * std::sin(t * 1.7) + std::sin(t * 7.1);
  s.arm.wrench_tool[2] = (duty_[0] > 0 ? 9.0 : 3.0) + 1.5 * std::sin(t * 3.3);
  s.battery_v = 28.9 - missionElapsedS() / 900.0;
  s.battery_a = 6.5;
  const HotSpot hot = hotSpot();
  s.figures = fire::figures({duty_, {duty_[0] * 2.1, duty_[1] * 2.0}, tank_, sprayed_l_},
                            std::min(sprayed_l_ * 0.75, 1.0) * 6.0, hot.peak_c + 273.15);
  s.resets = static_cast<int>(legs_.size()) - 1;
  const double recorded_s = recording_ ? toSeconds(now_ - recording_since_) : recorded_s_;
  if (recorded_s > 0.0 || recording_) {
    s.recording = {recording_, "run-20261122-1705.mcap",
                   recorded_s, static_cast<std::uint64_t>(recorded_s * 1.3e6),
                   0,          41e9 - recorded_s * 1.3e6,
                   ""};
  }
  s.macro = {macro_,       static_cast<int>(macro_progress_ * 4) + 1, 4, "spray", macro_progress_,
             macro_result_};
  s.speed_scale = speed_scale_;
  s.mission_elapsed_s = missionElapsedS();
  s.operators = {holder_name_};
  if (tank_[0] + tank_[1] < 6.9 && tank_[0] + tank_[1] > 6.0 && running_) {
    s.alarms.push_back({"water.low", AlarmLevel::Advisory, "Water below 7 l (est.)",
                        "enough for one more fire place", mission_start_, true, false});
  }
  return s;
}

Scene FakeRobot::scene() const {
  Scene s;
  s.stamp = now_;
  s.arena = makeFakeArena();
  FireSite site;
  site.stamp = now_;
  site.places = places();
  site.place_checks = placeChecks();
  s.planned.stamp = now_;
  s.planned.waypoints_map = {{0, 0, 0}, {2.5, 0, 0}, {7.4, 0, 0}, {8.6, 1.6, 0}, {9.95, 2.8, 0}};
  s.planned.next = at_ == 0 ? 1 : 4;
  if (at_ >= 6) {
    s.planned.waypoints_map = {{9.95, 2.8, 0}, {9.6, -0.6, -0.78}, {10.6, -2.45, -1.57}};
    s.planned.next = at_ == 6 ? 1 : 2;
  }
  if (at_ >= 8 && running_) {
    FireEstimate fire;
    fire.stamp = now_;
    fire.p_map = {10.58, -4.58, 1.01};
    fire.covariance = Eigen::Vector3d(4e-4, 9e-4, 4e-4).asDiagonal();
    fire.views = 12 + static_cast<int>(inStateS() * 3);
    fire.peak_k = hotSpot().peak_c + 273.15;
    fire.range_m = 0.86;
    fire.baseline_range_m = 0.93;
    fire.place = "place 2";
    site.fires.push_back(fire);
    const Eigen::Isometry3d X_map_nozzle =
        toIsometry(pose_) * geometry_.X_base_flange(q_) * geometry_.X_flange_nozzle.pose();
    const Eigen::Vector3d p = X_map_nozzle.translation();
    const Eigen::Vector3d v = (fire.p_map - p) / 0.3 + Eigen::Vector3d(0, 0, 0.5 * 9.81 * 0.3);
    for (double t = 0; t <= 0.3; t += 0.02) {
      site.jet_map.push_back(p + v * t + Eigen::Vector3d(0, 0, -0.5 * 9.81 * t * t));
    }
    site.spraying = duty_[0] > 0;
  }
  s.items = fire::sceneItems(site);
  s.detail = wire::encodeDetail(site);
  return s;
}

MissionInfo FakeRobot::missionInfo() const {
  MissionInfo info = fire::missionInfo(0.5, 30.0);
  info.mission = "fire";
  info.mission_uuid = info_.mission_uuid;
  info.actuators = {{kPumps, "Both pumps, duty"}};
  return info;
}

std::vector<MacroInfo> FakeRobot::macros() const {
  return {{"spray fire 1", "aim at place 1 and spray", 18, "start within 5 cm", "est. 0.9 l"},
          {"spray fire 2", "aim at place 2 and spray", 18, "start within 5 cm", "est. 0.9 l"},
          {"arm park", "fold the arm above the deck", 6, "from anywhere", ""}};
}

}  // namespace kiln::gui
