#include "gui/link/fake_robot.h"

#include <algorithm>
#include <cmath>

#include "common/config/resources.h"

namespace kiln::gui {

namespace {
constexpr double kDriveSpeed_mps = 0.8;
constexpr double kTurnSpeed_radps = 0.7;
constexpr double kPumpFlow_lps = 1.6 / 60.0;
constexpr std::size_t kHistory = 60;
const Pose2 kHub{7.4, 0.0, 0.0};
const Pose2 kPlace1{9.95, 2.8, 0.0};
const Pose2 kPlace2{10.6, -2.45, -1.5708};

bool isSpraying(const std::string& s) { return s == "SpraySteady" || s == "SprayPattern"; }
}  // namespace

FakeRobot::FakeRobot(std::uint64_t seed) : random_(seed), info_(makeFakeFireGraph()) {
  if (const auto path = resourcePath("robot_model/bob.yaml")) {
    if (!loadConfig(*path, geometry_)) geometry_ = {};
  }
  q_ = RobotGeometry::radians(geometry_.q_drive_deg);
  std::uniform_real_distribution<double> stretch(0.9, 1.15);
  for (const Scripted& row : std::vector<Scripted>{{"EnterBuilding", 12},
                                                   {"NextLocation", 0.6},
                                                   {"DriveToLocation", 9},
                                                   {"ArmSearch", 12},
                                                   {"HeatFound", 0.8},
                                                   {"NextLocation", 0.6},
                                                   {"DriveToLocation", 12},
                                                   {"ArmSearch", 11},
                                                   {"HeatFound", 0.8},
                                                   {"AimHose", 14},
                                                   {"StartPump", 1.0},
                                                   {"SpraySteady", 16},
                                                   {"SprayPattern", 16},
                                                   {"StopPump", 1.2},
                                                   {"NextLocation", 0.6},
                                                   {"MissionDone", 0}}) {
    script_.push_back({row.state, row.seconds * stretch(random_)});
  }
  history_.push_back({0, state_, now_, {}, TransitionCause::Start, {}});
}

void FakeRobot::startMission() {
  if (running_) return;
  running_ = true;
  terminal_ = success_ = false;
  mode_ = Mode::Autonomous;
  mission_start_ = now_;
  at_ = 0;
  say(2, "mission fire started");
  enter(script_.front().state, TransitionCause::Normal, {});
}

void FakeRobot::enter(const std::string& state, TransitionCause cause, const std::string& note) {
  if (!history_.empty()) history_.back().left = now_;
  state_ = state;
  entered_ = now_;
  held_s_ = 0.0;
  history_.push_back({++step_, state, now_, {}, cause, note});
  if (history_.size() > kHistory) history_.pop_front();
  const auto info = std::find_if(info_.states.begin(), info_.states.end(),
                                 [&](const FsmStateInfo& s) { return s.name == state; });
  say(2, "entered " + info->label + (note.empty() ? "" : " (" + note + ")"));
  if (!info->terminal) return;
  terminal_ = true;
  success_ = info->success;
  running_ = false;
  mission_end_ = now_;
}

void FakeRobot::advanceTo(Stamp now) {
  if (now_ == Stamp{})
    entered_ = history_.back().entered = now;  // the robot's clock does not start at zero
  const double dt_s = std::clamp(toSeconds(now - now_), 0.0, 1.0);
  now_ = now;
  const bool mission_moves = running_ && !paused_ && !stopped_ && mode_ != Mode::Teleop;
  if (!mission_moves) held_s_ += dt_s;
  if (mission_moves && at_ < script_.size() && inStateS() >= script_[at_].seconds) {
    if (++at_ < script_.size()) enter(script_[at_].state, TransitionCause::Normal, {});
  }
  duty_ = hand_duty_;
  if (mission_moves && isSpraying(state_)) duty_ = {1.0, 1.0};
  if (stopped_) duty_ = {};
  for (std::size_t i = 0; i < 2; ++i) {
    const double litres = duty_[i] * kPumpFlow_lps * dt_s;
    tank_[i] = std::max(0.0, tank_[i] - litres);
    sprayed_l_ += litres;
  }
  if (!macro_.empty()) macro_progress_ = std::min(1.0, macro_progress_ + dt_s / 18.0);
  if (macro_progress_ >= 1.0) {
    macro_.clear();
    macro_progress_ = 0.0;
    macro_result_ = "done";
  }
  if (!stopped_) moveBody(dt_s);
  leaveTrail();
}

Pose2 FakeRobot::goal() const {
  if (state_ == "EnterBuilding") return kHub;
  const bool first = at_ < 5;
  if (state_ == "WaitForStart") return {};
  return first ? kPlace1 : kPlace2;
}

void FakeRobot::moveBody(double dt_s) {
  if (mode_ == Mode::Teleop) {
    pose_ = pose_ * Pose2{jog_.vx_mps * dt_s, jog_.vy_mps * dt_s, jog_.wz_radps * dt_s};
    return;
  }
  jog_ = {};
  if (!running_ || paused_) return;
  const Vector6d drive = RobotGeometry::radians(geometry_.q_drive_deg);
  Vector6d target = drive;
  if (state_ == "EnterBuilding" || state_ == "DriveToLocation") {
    const Pose2 to = goal();
    const double dx = to.x_m - pose_.x_m;
    const double dy = to.y_m - pose_.y_m;
    const double distance = std::hypot(dx, dy);
    const double move = std::min(distance, kDriveSpeed_mps * dt_s);
    const double turn = wrapAngle(to.yaw_rad - pose_.yaw_rad);
    const double w = std::clamp(turn / std::max(dt_s, 1e-3), -kTurnSpeed_radps, kTurnSpeed_radps);
    if (distance > 1e-6) {
      pose_.x_m += dx / distance * move;
      pose_.y_m += dy / distance * move;
      const double heading = std::atan2(dy, dx) - pose_.yaw_rad;
      const double v = dt_s > 0 ? move / dt_s : 0.0;
      jog_ = {v * std::cos(heading), v * std::sin(heading), w};
    }
    pose_.yaw_rad += w * dt_s;
  } else if (state_ == "ArmSearch") {
    target[0] += M_PI + 0.5 * std::sin(inStateS() * 0.6);
    target[1] += 0.4;
    target[3] += 0.2 * std::sin(inStateS() * 1.1);
  } else if (state_ == "AimHose" || state_ == "StartPump" || state_ == "StopPump" ||
             isSpraying(state_)) {
    target[0] += M_PI;
    target[1] += 0.55;
    if (state_ == "SprayPattern") target[0] += 0.03 * std::sin(inStateS() * 3.0);
  }
  q_ += (target - q_).cwiseMax(-0.6 * dt_s).cwiseMin(0.6 * dt_s);
}

FakeRobot::HotSpot FakeRobot::hotSpot() const {
  HotSpot spot;
  spot.peak_c = 25.0 + 105.0 * (1.0 - std::exp(-missionElapsedS() / 60.0));
  const bool at_fire = at_ >= 7;
  if (!at_fire || !(state_ == "ArmSearch" || state_ == "HeatFound" || state_ == "AimHose" ||
                    state_ == "StartPump" || isSpraying(state_))) {
    return {-1, -1, spot.peak_c};
  }
  const double swing = state_ == "ArmSearch" ? 1.0 : 0.08;
  spot.u = 79.5 + swing * 45.0 * std::sin(inStateS() * 0.6 + 0.4);
  spot.v = 58.0 + swing * 12.0 * std::sin(inStateS() * 1.1);
  if (isSpraying(state_))
    spot.peak_c -= std::min(70.0, inStateS() * (state_ == "SpraySteady" ? 1.5 : 3.0));
  return spot;
}

bool FakeRobot::cameraFrozen() const {
  const double t = missionElapsedS();
  return t > 62.0 && t < 68.5;
}

double FakeRobot::missionElapsedS() const {
  if (mission_start_ == Stamp{} && !running_ && !terminal_) return 0.0;
  return toSeconds((terminal_ ? mission_end_ : now_) - mission_start_);
}

std::vector<LogLine> FakeRobot::takeLog() { return std::exchange(log_, {}); }

void FakeRobot::say(int level, const std::string& text) {
  log_.push_back({now_, level, "mission", text});
}

}  // namespace kiln::gui
