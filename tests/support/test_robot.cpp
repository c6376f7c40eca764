#include "tests/support/test_robot.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "common/config/resources.h"
#include "common/core/check.h"
#include "common/core/log.h"
#include "common/core/manual_executor.h"
#include "common/geom/frames.h"
#include "robot/app/mission_control.h"
#include "robot/app/robot_macros.h"
#include "robot/app/robot_settings.h"
#include "robot/app/safety_files.h"
#include "robot/app/standstill.h"
#include "robot/app/state_history.h"
#include "robot/app/telemetry_hub.h"
#include "robot/app/trajectory_log.h"
#include "robot/skills/arena_fence.h"
#include "tests/support/fake_arena.h"
#include "tests/support/fake_devices.h"

namespace kiln {
namespace {

constexpr double kImagePeriod_s = 1.0 / 8.77;
constexpr std::size_t kBurning = 1;  ///< index of the place
constexpr double kStandstill_mps = 0.02;

template <class T>
T value(Result<T> result) {
  KILN_CHECK(result.has_value(), result ? std::string() : result.error().message);
  return std::move(*result);
}

}  // namespace

struct TestRobot::Impl {
  explicit Impl(TestRobot& robot);
  void control(Stamp now);
  void mission(Stamp now);
  void look();
  [[nodiscard]] std::deque<ScanWindow::Entry> lidarScans() const;
  void carryToStart();
  [[nodiscard]] Stamp now() const { return clock_.now(); }
  [[nodiscard]] Pose2 pose() const { return base_device_.truePose(); }
  [[nodiscard]] std::vector<Check> allChecks() const;
  [[nodiscard]] GateSituation situation() const;
  [[nodiscard]] std::string positionLost() const;
  [[nodiscard]] std::optional<Eigen::Isometry3d> flangeAt(Stamp stamp) const;

  TestRobot& robot_;
  ManualClock clock_{Stamp{std::chrono::seconds(1000)}};
  ManualExecutor executor_{clock_};
  RobotSettings settings_;
  RobotGeometry geometry_;
  ArenaMap arena_;
  FireSiteMap site_;
  StopLatch stop_;
  FakeArm arm_device_;
  FakeBase base_device_;
  FakePumps pumps_device_;
  BaseController base_;
  ArmController arm_;
  PumpController pumps_;
  StateHistory history_;
  PlaceScans scans_;
  FakeReferee referee_;
  HotPlate plate_;
  DriveTo drive_;
  MoveArm move_arm_;
  RobotBelief belief_;
  Authority authority_;
  std::optional<MacroRunner> macros_;
  Teleop teleop_;
  AlarmBook alarms_;
  std::unique_ptr<Mission> mission_;
  MissionInfo info_;
  std::unique_ptr<MissionHost> host_;
  std::unique_ptr<MissionControl> control_;
  TrajectoryLog driven_;
  ThermalImagePtr thermal_;
  std::shared_ptr<const MissionDetail> stream_;
  RecordingStatus recording_;
  Stamp recording_since_;
  std::vector<ReceivedCommand> received_;
  std::map<std::string, OperatorPeer> peers_;
  std::set<std::string> silent_;
  std::uint64_t nonce_ = 0;
  std::vector<CommandAck> acks_;
  std::vector<LogLine> log_;
  int resets_ = 0;
  LogSinkHandle log_sink_;  ///< last: calls into what is above
};

TestRobot::Impl::Impl(TestRobot& robot)
    : robot_(robot),
      geometry_(value(loadResource<RobotGeometry>(settings_.geometry))),
      arena_(value(loadArena(settings_.arena))),
      site_(value(loadFireSite(arena_))),
      arm_device_(clock_, geometry_, RobotGeometry::radians(geometry_.q_park_deg)),
      base_device_(clock_, geometry_),
      pumps_device_(clock_),
      base_(settings_.base, geometry_, base_device_, stop_),
      arm_(settings_.arm, geometry_, arm_device_, stop_),
      pumps_(settings_.pumps, pumps_device_, stop_),
      scans_(site_, site_.places[kBurning].name, robot_.misplaced),
      referee_([this] { carryToStart(); }),
      plate_(site_.places[kBurning]),
      drive_(settings_.drive_to, geometry_, arena_, base_, [this] { return pose(); }),
      move_arm_(settings_.move_arm, geometry_, arena_, arm_, arm_device_,
                [this] { return pose(); }),
      authority_(settings_.authority),
      teleop_(settings_.teleop, geometry_, arena_, base_, arm_, pumps_) {
  base_device_.setTruePose(arena_.start.pose());
  base_.setGeofence(std::make_shared<const Geofence>(
      value(arenaFence(arena_, geometry_, settings_.drive_to.fence))));
  mission_ = value(findMission("fire")->make(
      *settings_.missions.find("fire"), "test-uuid",
      {clock_, executor_, arena_, geometry_, belief_, drive_, move_arm_, arm_device_, pumps_,
       [this] { return pose(); }, [this] { return lidarScans(); },
       [this](Stamp stamp) { return flangeAt(stamp); }, [](Stamp) { return std::nullopt; },
       [this](const ThermalImagePtr& image) { thermal_ = image; },
       [this](MissionDetail detail) {
         stream_ = std::make_shared<const MissionDetail>(std::move(detail));
       }}));
  info_ = mission_->info();
  info_.mission = "fire";
  info_.mission_uuid = "test-uuid";
  info_.actuators = Teleop::actuators();
  macros_.emplace(
      MacroRunner::Parts{[this] { return pose(); },
                         [this](const std::string& place) { return mission_->workPose(place); },
                         [this] { return authority_.epoch().value(); }},
      value(robotMacros(geometry_, move_arm_, settings_.macros, *mission_, "fire")));
  host_ = std::make_unique<MissionHost>(*mission_, belief_, stop_, clock_);
  control_ = std::make_unique<MissionControl>(MissionControl::Parts{
      *host_, authority_, teleop_, *macros_, alarms_, stop_, arm_device_, arm_, &referee_,
      [this] { return pose(); }, [this](Stamp) { return situation(); },
      [this](const Pose2& X_map_base) {
        base_device_.setTruePose(X_map_base);
        robot_.health = LocalizationHealth::Good;
      },
      [this](bool on) {
        if (on && !recording_.on) recording_since_ = now();
        recording_.on = on;
        recording_.file = "run.mcap";
        recording_.disk_free_bytes = 41e9;
      }});
  log_sink_ = addLogSink([this](const LogRecord& record) {
    log_.push_back({now(), record.level, record.logger, record.text});
  });
  executor_.every(fromSeconds(1.0 / settings_.arm.servo_rate_hz), "control", kPriorityControl,
                  [this](Stamp t) { control(t); });
  executor_.every(std::chrono::milliseconds(20), "mission", kPriorityMission,
                  [this](Stamp t) { mission(t); });
  executor_.every(fromSeconds(kImagePeriod_s), "thermal", kPriorityMission,
                  [this](Stamp) { look(); });
}

std::deque<ScanWindow::Entry> TestRobot::Impl::lidarScans() const {
  return scans_.look(
      now(), toIsometry(pose()),
      geometry_.X_base_flange(arm_device_.state()->q) * geometry_.X_flange_lidar.pose());
}

void TestRobot::Impl::control(Stamp now) {
  arm_device_.advance();
  base_device_.advance();
  pumps_device_.advance();
  base_.tick(now);
  arm_.tick(now);
  pumps_.tick(now);
  history_.addJoints(now, arm_device_.state()->q);
  history_.addOdometry(now, pose());
}

void TestRobot::Impl::mission(Stamp now) {
  base_.placeInMap(positionLost().empty()
                       ? std::optional(pose() * inverse(base_.tracking().X_odom_base))
                       : std::nullopt);
  control_->checkPosition(positionLost(), now);
  control_->observeStop(now);
  std::vector<OperatorPeer> peers;
  for (auto& [client, peer] : peers_) {
    if (silent_.count(client) == 0) peer.last_heard = now;
    peers.push_back(peer);
  }
  const Authority::Step step = authority_.step(std::exchange(received_, {}), peers, *control_, now);
  acks_.insert(acks_.end(), step.acks.begin(), step.acks.end());
  for (const std::string& event : step.events) logger("operators")->info("{}", event);
  belief_.X_map_base = pose();
  belief_.pose_stamp = now;
  host_->goOnWhenAllowed(control_->situation(now), now);
  control_->step(now);
  for (const MissionAlarm& alarm : mission_->alarms(now))
    alarms_.set(alarm.id, true, alarm.level, alarm.text, alarm.action, now);
  (void)driven_.add(now, pose(), resets_);
}

void TestRobot::Impl::look() {
  const double lit_s = host_->starts() > 0 ? belief_.elapsedS(now()) : 0.0;
  auto image = std::make_shared<ThermalImage>(
      plate_.look(*flangeAt(now()) * geometry_.X_flange_thermal.pose(), lit_s, robot_.misplaced));
  image->stamp = now();
  mission_->onThermal(image);
}

std::optional<Eigen::Isometry3d> TestRobot::Impl::flangeAt(Stamp stamp) const {
  const auto sample = history_.at(stamp);
  if (!sample) return std::nullopt;
  return toIsometry(sample->X_odom_base) * geometry_.X_base_flange(sample->q);
}

std::string TestRobot::Impl::positionLost() const {
  return robot_.health == LocalizationHealth::Lost ? "position lost: no scan fits the map" : "";
}

std::vector<Check> TestRobot::Impl::allChecks() const {
  std::vector<Check> all = robot_.checks;
  for (Check& check : mission_->checks(now())) all.push_back(std::move(check));
  return all;
}

GateSituation TestRobot::Impl::situation() const {
  GateSituation found;
  found.protective_stop = arm_device_.state()->safety == ArmSafetyMode::ProtectiveStop;
  const Twist2 moving = base_.tracking().measured;
  found.base_moving = std::hypot(moving.vx_mps, moving.vy_mps) > kStandstill_mps;
  found.ready = allOk(allChecks());
  found.not_ready_reason = firstFailure(allChecks());
  found.position_lost = positionLost();
  found.mission = &info_;
  found.view_age_s = robot_.view_age_s;
  return found;
}

void TestRobot::Impl::carryToStart() {
  base_device_.setTruePose(arena_.start.pose());
  base_.resetOdometry();
  ++resets_;
  control_->onReset(now());
}

TestRobot::TestRobot() {
  checks = {{"Devices", true, "connected"}, {"LiDAR", true, "0.05 s old"}, {"Disk", true, "41 GB"}};
  impl_ = std::make_unique<Impl>(*this);
  advance(0.3);
}

TestRobot::~TestRobot() = default;

void TestRobot::advance(double seconds) { impl_->executor_.runUntil(now() + fromSeconds(seconds)); }

std::uint64_t TestRobot::send(const std::string& client, const std::string& name, CommandBody body,
                              std::uint64_t press) {
  OperatorPeer& peer = impl_->peers_[client];
  peer.client_id = client;
  peer.name = name;
  ReceivedCommand received;
  received.rtt_s = rtt_s;
  Command& command = received.command;
  command.client_id = client;
  command.operator_name = name;
  command.nonce = ++impl_->nonce_;
  const LeaseStatus lease = impl_->authority_.lease(now());
  command.lease_epoch = lease.holder_client == client ? lease.epoch : 0;
  command.issued = received.received = now();
  command.press = press;
  command.body = std::move(body);
  impl_->received_.push_back(std::move(received));
  return impl_->nonce_;
}

CommandAck TestRobot::ask(const std::string& client, const std::string& name, CommandBody body) {
  const std::uint64_t nonce = send(client, name, std::move(body));
  advance(0.02);
  for (const CommandAck& ack : impl_->acks_)
    if (ack.nonce == nonce) return ack;
  return {};
}

void TestRobot::setHeard(const std::string& client, bool heard) {
  heard ? void(impl_->silent_.erase(client)) : void(impl_->silent_.insert(client));
}

void TestRobot::stop(const std::string& who) { (void)impl_->stop_.set(who, now()); }

RobotStatus TestRobot::status() const {
  const auto base = impl_->base_device_.state();
  RobotStatus s = impl_->control_->status(impl_->belief_, impl_->allChecks(), now());
  s.version = "test";
  proveStandstill(s.stop, impl_->arm_device_.state(), base, impl_->pumps_device_.state(), now());
  s.arm = *impl_->arm_device_.state();
  s.X_map_base = pose();
  s.twist = knownTwist(impl_->base_.tracking().measured, base, now());
  for (std::size_t i = 0; i < 4; ++i) s.wheel_steer_rad[i] = base->wheels[i].steer_rad;
  s.battery_v = base->battery_v;
  s.recording = impl_->recording_;
  if (impl_->recording_.on) s.recording.duration_s = toSeconds(now() - impl_->recording_since_);
  for (const auto& [client, peer] : impl_->peers_) s.operators.push_back(peer.name);
  return s;
}

Scene TestRobot::scene() const {
  Scene s;
  s.stamp = now();
  s.planned = {now(), impl_->drive_.waypoints(), impl_->drive_.nextIndex()};
  s.arena = sceneBoxes(impl_->arena_);
  impl_->mission_->describe(s, now());
  return s;
}

LocalizationStatus TestRobot::localization() const {
  LocalizationStatus s;
  s.stamp = now();
  s.health = health;
  const bool good = health == LocalizationHealth::Good;
  s.method = good ? "surfel map" : "odometry";
  s.X_map_base = toIsometry(pose());
  s.sigma_m = good ? 0.009 : health == LocalizationHealth::Degraded ? 0.21 : 0.62;
  s.sigma_yaw_rad = good ? 0.004 : 0.03;
  s.covariance = Eigen::Vector3d(s.sigma_m * s.sigma_m, 0.3 * s.sigma_m * s.sigma_m,
                                 s.sigma_yaw_rad * s.sigma_yaw_rad)
                     .asDiagonal();
  s.match_age_s = good ? 0.1 : 6.4;
  s.inlier_fraction = good ? 0.87 : 0.21;
  if (!good) s.reason = "21 % of the scan fits the map; drive slowly or set the pose on the map";
  s.resets = impl_->resets_;
  return s;
}

void TestRobot::startMission() { impl_->host_->waitForStart(); }
std::vector<CommandAck> TestRobot::takeAcks() { return std::exchange(impl_->acks_, {}); }
std::vector<LogLine> TestRobot::takeLog() { return std::exchange(impl_->log_, {}); }
FsmInfo TestRobot::fsmInfo() const { return impl_->mission_->machine().info(); }
FsmStatus TestRobot::fsmStatus() const { return impl_->host_->fsm(); }
const Trajectory& TestRobot::trajectory() const { return impl_->driven_.trajectory(); }
std::vector<MacroInfo> TestRobot::macros() const { return impl_->macros_->list(); }
const ThermalImagePtr& TestRobot::thermal() const { return impl_->thermal_; }
const std::shared_ptr<const MissionDetail>& TestRobot::stream() const { return impl_->stream_; }
const MissionInfo& TestRobot::missionInfo() const { return impl_->info_; }
const Clock& TestRobot::clock() const { return impl_->clock_; }
Pose2 TestRobot::pose() const { return impl_->pose(); }
bool TestRobot::held(HoldKind kind) const { return impl_->authority_.held(kind, now()); }
AlarmBook& TestRobot::alarms() { return impl_->alarms_; }
FakeArm& TestRobot::arm() { return impl_->arm_device_; }
FakePumps& TestRobot::pumps() { return impl_->pumps_device_; }

}  // namespace kiln
