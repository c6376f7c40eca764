#include "gui/link/fake_link.h"

#include <cmath>
#include <utility>

#include "common/wire/fire/codec/fire_codec.h"
#include "gui/link/fake_sensors.h"

namespace kiln::gui {

namespace {
constexpr int kTick_ms = 50;
constexpr double kTick_s = kTick_ms / 1000.0;
constexpr double kFirst_s = 1000.0;  ///< robot clocks do not start at zero
constexpr double kAutostart_s = 2.0;
}  // namespace

FakeLink::FakeLink(Options options, QObject* parent)
    : Link(parent),
      options_(options),
      clock_(Stamp{fromSeconds(kFirst_s)}),
      robot_(options.seed),
      heard_(clock_.now()) {
  robot_.advanceTo(clock_.now());
  connect(&timer_, &QTimer::timeout, this, [this] { step(kTick_s * options_.speed); });
}

void FakeLink::open() {
  lane_.reachable = true;
  HelloReply reply{
      true, "", "Bob", "fake", kProtocolVersion, robot_.fsmInfo().mission_uuid, Environment::Sim};
  emit hello(reply);
  emit fsmInfo(std::make_shared<const FsmInfo>(robot_.fsmInfo()));
  emit missionInfo(std::make_shared<const MissionInfo>(robot_.missionInfo()));
  emit macros(robot_.macros());
  emit stopLane(lane_);
  publishHealth();
  publishState();
  emit scene(std::make_shared<const Scene>(robot_.scene()));
  emit mapLayer(std::make_shared<const MapLayer>(makeFakeMap()));
  if (options_.run_by_timer) timer_.start(kTick_ms);
}

void FakeLink::close() { timer_.stop(); }

std::uint64_t FakeLink::send(const CommandBody& body) {
  sent_.push_back(body);
  const std::uint64_t nonce = next_nonce_++;
  if (silent_ || deaf_) return nonce;
  const FakeRobot::Ack answer =
      robot_.handle(clientId().toStdString(), operatorName().toStdString(), body);
  CommandAck message{clientId().toStdString(),
                     nonce,
                     std::string(commandName(body)),
                     answer.outcome,
                     answer.code,
                     answer.reason,
                     ""};
  // The answer travels: the caller must know the nonce before it sees the ack.
  QMetaObject::invokeMethod(
      this,
      [this, message] {
        emit ack(message);
        publishState();
      },
      Qt::QueuedConnection);
  return nonce;
}

std::uint64_t FakeLink::press() { return ++last_press_; }

void FakeLink::releaseSetpoint(const CommandBody& example) {
  if (held_.erase(example.index()) == 0) return;
  const auto others = std::exchange(held_, {});
  releaseSetpoints();
  for (const auto& [index, body] : others) startSetpoint(body, last_press_);
}

void FakeLink::startSetpoint(const CommandBody& body, std::uint64_t) {
  held_.insert_or_assign(body.index(), body);
  if (!silent_) robot_.handle(clientId().toStdString(), operatorName().toStdString(), body);
  // A macro restarts once, not at each repetition.
  if (auto* macro = std::get_if<HoldMacro>(&held_.at(body.index()))) macro->restart = false;
}

void FakeLink::releaseSetpoints() {
  held_.clear();
  if (!silent_) robot_.handle(clientId().toStdString(), operatorName().toStdString(), ReleaseAll{});
}

void FakeLink::stop() {
  lane_.pressed = true;
  lane_.acked = false;
  ++lane_.press;
  emit stopLane(lane_);
  if (!silent_) latchStop();
}

void FakeLink::latchStop() {
  robot_.stop(operatorName().toStdString());
  lane_.acked = true;
  lane_.pressed = false;
  lane_.latch_s = 0.012;
  emit stopLane(lane_);
  publishState();
}

void FakeLink::advance(double seconds) {
  for (double left = seconds; left > 1e-9; left -= kTick_s) step(std::min(left, kTick_s));
}

void FakeLink::step(double dt_s) {
  clock_.advanceBy(fromSeconds(dt_s));
  ++tick_;
  robot_.advanceTo(clock_.now());
  if (options_.autostart && toSeconds(clock_.now()) > kFirst_s + kAutostart_s &&
      robot_.missionElapsedS() == 0.0) {
    robot_.startMission();
  }
  if (!silent_) {
    heard_ = clock_.now();
    if (lane_.pressed) latchStop();  // kept since the link was lost
    for (const auto& [kind, body] : held_) {
      robot_.handle(clientId().toStdString(), operatorName().toStdString(), body);
    }
  }
  if (tick_ % 4 == 0) publishHealth();
  if (silent_) return;
  if (tick_ % 2 == 0) publishState();
  if (tick_ % 20 == 0) {
    emit scene(std::make_shared<const Scene>(robot_.scene()));
    emit trajectory(std::make_shared<const Trajectory>(robot_.trajectory()));
  }
  if (options_.with_sensors) publishSensors();
}

void FakeLink::publishState() {
  emit status(std::make_shared<const RobotStatus>(robot_.status()));
  emit fsmStatus(std::make_shared<const FsmStatus>(robot_.fsmStatus()));
  emit localization(std::make_shared<const LocalizationStatus>(robot_.localization()));
  const std::vector<LogLine> lines = robot_.takeLog();
  if (!lines.empty()) emit log(lines);
}

void FakeLink::publishSensors() {
  if (tick_ % 2 == 0) emit cloud(makeFakeCloud(robot_, tick_));
  if (tick_ % 2 == 1) {
    const ThermalImagePtr picture = makeFakeThermal(robot_, tick_);
    emit thermal(picture);
    emit missionStream(
        std::make_shared<const MissionDetail>(wire::encodeDetail(makeFakeHeat(robot_, *picture))));
  }
  if (tick_ % 3 == 0 && !robot_.cameraFrozen()) emit image(makeFakeCamera(robot_, tick_));
}

void FakeLink::publishHealth() {
  LinkHealth h;
  h.endpoint = QStringLiteral("fake");
  h.heard_age_s = toSeconds(clock_.now() - heard_);
  h.robot_hears_age_s = deaf_ ? 9.0 : h.heard_age_s;
  h.state = h.heard_age_s >= 1.5            ? LinkState::Lost
            : h.heard_age_s >= 0.5 || deaf_ ? LinkState::Degraded
                                            : LinkState::Up;
  const double t = robot_.missionElapsedS();
  const double burst = t > 30 && t < 36 ? 0.16 : 0.0;
  h.rtt_s = 0.055 + 0.012 * std::abs(std::sin(t * 2.3)) * std::abs(std::sin(t * 0.7)) + burst;
  h.loss = burst > 0 ? 0.03 : 0.0;
  if (h.state == LinkState::Lost)
    h.reason = tr("the robot has not been heard for %1 s").arg(h.heard_age_s, 0, 'f', 1);
  lane_.reachable = !silent_;
  emit stopLane(lane_);
  emit health(h);
}

}  // namespace kiln::gui
