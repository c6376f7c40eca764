#include "tests/gui/support/direct_link.h"

#include <algorithm>

#include "tests/gui/views/sample_world.h"

namespace kiln::gui {
namespace {

constexpr double kTick_s = 0.02;  // of the robot's mission
constexpr int kStatusTicks = 5, kSceneTicks = 50, kHealthTicks = 10;
constexpr int kCloudTicks = 10, kPictureTicks = 6;
constexpr int kCloudColumns = 450;
constexpr double kDegraded_s = 0.5, kLost_s = 1.5;  // OperatorSession::Config

}  // namespace

DirectLink::DirectLink(bool sensors, QObject* parent)
    : Link(parent),
      sensors_(sensors),
      world_(std::make_unique<SampleWorld>()),
      heard_(robot_.now()),
      robot_heard_(robot_.now()) {
  connect(&timer_, &QTimer::timeout, this, [this] {
    const double behind_s =
        toSeconds(wall_.now() - opened_wall_) - toSeconds(robot_.now() - opened_);
    if (behind_s > 0.0) advance(std::min(behind_s, 1.0));
  });
}

DirectLink::~DirectLink() = default;

void DirectLink::open() {
  lane_.reachable = true;
  emit hello(
      {true, "", "Bob", "test", kProtocolVersion, robot_.fsmInfo().mission_uuid, Environment::Sim});
  emit fsmInfo(std::make_shared<const FsmInfo>(robot_.fsmInfo()));
  emit missionInfo(std::make_shared<const MissionInfo>(robot_.missionInfo()));
  emit macros(robot_.macros());
  emit scene(std::make_shared<const Scene>(robot_.scene()));
  publishHealth();
  publishState();
}

void DirectLink::runByTimer() {
  opened_ = robot_.now();
  opened_wall_ = wall_.now();
  timer_.start(static_cast<int>(1000 * kTick_s));
}

std::uint64_t DirectLink::send(const CommandBody& body) {
  sent_.push_back(body);
  const std::uint64_t nonce =
      silent_ || deaf_ ? ++lost_nonce_ : robot_.send(kClient, kOperator, body);
  (void)tracker_.sent(nonce, body, monotonic());
  return nonce;
}

void DirectLink::startSetpoint(const CommandBody& body, std::uint64_t press) {
  holds_.hold(body, press, monotonic());
}

Monotonic::time_point DirectLink::monotonic() const {
  return Monotonic::time_point(robot_.now().time_since_epoch());
}

void DirectLink::setSilent(bool silent) {
  silent_ = silent;
  robot_.setHeard(kClient, !silent_ && !deaf_);
}

void DirectLink::setDeaf(bool deaf) {
  deaf_ = deaf;
  robot_.setHeard(kClient, !silent_ && !deaf_);
}

void DirectLink::stop() {
  lane_.pressed = true;
  lane_.acked = false;
  ++lane_.press;
  emit stopLane(lane_);
  if (!silent_) latchStop();
}

void DirectLink::latchStop() {
  robot_.stop(kOperator);
  lane_.acked = true;
  lane_.pressed = false;
  lane_.latch_s = 0.012;
  emit stopLane(lane_);
  publishState();
}

void DirectLink::advance(double seconds) {
  for (double left = seconds; left > 1e-9; left -= kTick_s) step();
}

void DirectLink::step() {
  for (const HoldStream::Setpoint& setpoint : holds_.due(monotonic()))
    if (!silent_ && !deaf_) (void)robot_.send(kClient, kOperator, setpoint.body, setpoint.press);
  robot_.advance(kTick_s);
  ++tick_;
  if (!silent_) heard_ = robot_.now();
  if (!silent_ && !deaf_) robot_heard_ = robot_.now();
  if (!silent_ && lane_.pressed) latchStop();  // kept since the link was lost
  if (tick_ % kHealthTicks == 0) publishHealth();
  for (const CommandUpdate& update : tracker_.expire(monotonic())) emit command(update);
  if (silent_) return;
  deliverAcks();
  if (tick_ % kStatusTicks == 0) publishState();
  if (tick_ % kSceneTicks == 0) {
    emit scene(std::make_shared<const Scene>(robot_.scene()));
    emit trajectory(std::make_shared<const Trajectory>(robot_.trajectory()));
  }
  if (sensors_) publishSensors();
}

void DirectLink::deliverAcks() {
  const std::vector<CommandAck> acks = robot_.takeAcks();
  for (const CommandAck& ack : acks) {
    if (ack.client_id == kClient) emit command(tracker_.answered(ack, monotonic()));
  }
  if (!acks.empty()) publishState();
}

void DirectLink::publishState() {
  emit status(std::make_shared<const RobotStatus>(robot_.status()));
  emit fsmStatus(std::make_shared<const FsmStatus>(robot_.fsmStatus()));
  emit localization(std::make_shared<const LocalizationStatus>(robot_.localization()));
  const std::vector<LogLine> lines = robot_.takeLog();
  if (!lines.empty()) emit log(lines);
}

void DirectLink::publishSensors() {
  if (tick_ % kCloudTicks == 0) emit cloud(world_->cloud(robot_.status(), kCloudColumns));
  if (tick_ % kPictureTicks == 0) emit image(world_->picture(robot_.now(), tick_));
  if (robot_.thermal() != shown_thermal_) emit thermal(shown_thermal_ = robot_.thermal());
  if (robot_.stream() != shown_stream_) emit missionStream(shown_stream_ = robot_.stream());
}

void DirectLink::publishHealth() {
  LinkHealth h;
  h.endpoint = QStringLiteral("test");
  h.heard_age_s = toSeconds(robot_.now() - heard_);
  h.robot_hears_age_s = toSeconds(robot_.now() - robot_heard_);
  h.state = h.heard_age_s >= kLost_s                                      ? LinkState::Lost
            : std::max(h.heard_age_s, h.robot_hears_age_s) >= kDegraded_s ? LinkState::Degraded
                                                                          : LinkState::Up;
  h.rtt_s = robot_.rtt_s;
  if (h.state == LinkState::Lost)
    h.reason = tr("the robot has not been heard for %1 s").arg(h.heard_age_s, 0, 'f', 1);
  lane_.reachable = !silent_;
  emit stopLane(lane_);
  emit health(h);
}

}  // namespace kiln::gui
