#include "gui/link/robot_link.h"

#include <QTimer>
#include <algorithm>

#include "common/client/operator_session.h"
#include "gui/link/topic_inboxes.h"

namespace kiln::gui {

namespace {
constexpr std::size_t kCommandQueue = 200;
constexpr double kLossSmoothing = 0.02;  // about the last 50 status messages
constexpr int kAckShown_ms = 500;        // until the robot's status tells of the latch itself

LinkState stateOf(kiln::LinkState state) {
  switch (state) {
    case kiln::LinkState::Connecting:
      return LinkState::Connecting;
    case kiln::LinkState::Connected:
      return LinkState::Up;
    case kiln::LinkState::Degraded:
      return LinkState::Degraded;
    case kiln::LinkState::Lost:
      return LinkState::Lost;
    case kiln::LinkState::Refused:
      return LinkState::Refused;
  }
  return LinkState::Connecting;
}

}  // namespace

struct RobotLink::Impl {
  explicit Impl(RobotLink& owner);
  [[nodiscard]] OperatorSession::Callbacks callbacks();
  void deliverHealth(const LinkReport& report);
  void deliverStop(const StopReport& report);
  void deliverQuietLane();
  void noteArrival(const Arrival& arrival);

  RobotLink& link;
  Inbox<LinkReport> health;
  Inbox<StopReport> stop;
  Inbox<HelloReply> hello;
  Batches<CommandUpdate> commands;
  double loss = 0.0;
  bool reachable = false;
  TopicInboxes topics;
  std::unique_ptr<OperatorSession> session;  // last: its threads call all of the above
};

RobotLink::Impl::Impl(RobotLink& owner)
    : link(owner),
      health(owner, [this](const LinkReport& r) { deliverHealth(r); }),
      stop(owner, [this](const StopReport& r) { deliverStop(r); }),
      hello(owner, [this](const HelloReply& r) { emit link.hello(r); }),
      commands(owner, kCommandQueue,
               [this](const std::vector<CommandUpdate>& batch) {
                 for (const CommandUpdate& update : batch) emit link.command(update);
               }),
      topics(owner, [this](const Arrival& arrival) { noteArrival(arrival); }) {}

OperatorSession::Callbacks RobotLink::Impl::callbacks() {
  OperatorSession::Callbacks c = topics.callbacks();
  c.on_link = [this](const LinkReport& r) { health.put(r); };
  c.on_hello = [this](const HelloReply& r) { hello.put(r); };
  c.on_stop = [this](const StopReport& r) { stop.put(r); };
  c.on_command = [this](const CommandUpdate& u) { commands.put(u); };
  return c;
}

void RobotLink::Impl::noteArrival(const Arrival& arrival) {
  for (std::uint64_t i = 0; i < std::min<std::uint64_t>(arrival.lost_before, 50); ++i)
    loss += kLossSmoothing * (1 - loss);
  loss -= kLossSmoothing * loss;
}

void RobotLink::Impl::deliverHealth(const LinkReport& r) {
  LinkHealth h;
  h.state = stateOf(r.state);
  h.endpoint = QString::fromStdString(link.options_.endpoint);
  h.reason = QString::fromStdString(r.reason);
  h.rtt_s = r.clock_known ? r.rtt_s : -1.0;
  h.loss = loss;
  h.heard_age_s = std::max(0.0, r.rx_age_s);
  h.robot_hears_age_s = std::max(0.0, r.robot_rx_age_s);
  h.drops = r.drops;
  reachable = h.state == LinkState::Up || h.state == LinkState::Degraded;
  emit link.health(h);
  if (!session) return;
  // A press that waits for its answer, or for a link, stays shown.
  const StopReport pressed = session->stopReport();
  pressed.state == StopReport::State::Sent ? deliverStop(pressed) : deliverQuietLane();
}

void RobotLink::Impl::deliverStop(const StopReport& r) {
  StopLane lane;
  lane.reachable = reachable;
  lane.pressed = r.state != StopReport::State::Idle;
  lane.acked = r.state == StopReport::State::Latched;
  lane.latch_s = lane.acked ? r.round_trip_s : -1.0;
  lane.press = r.press;
  emit link.stopLane(lane);
  if (!lane.acked) return;
  QTimer::singleShot(kAckShown_ms, &link, [this] {
    if (session && session->stopReport().state == StopReport::State::Latched) deliverQuietLane();
  });
}

/// Nothing is asked for and no answer is to be shown: what the robot says of itself counts.
void RobotLink::Impl::deliverQuietLane() {
  StopReport quiet;
  quiet.press = session->stopReport().press;
  deliverStop(quiet);
}

RobotLink::RobotLink(Options options, QObject* parent)
    : Link(parent), options_(std::move(options)), impl_(std::make_unique<Impl>(*this)) {}

RobotLink::~RobotLink() { close(); }

Result<void> RobotLink::connectToRobot() {
  OperatorSession::Config config;
  config.endpoint = options_.endpoint;
  config.operator_name = options_.operator_name;
  config.program_version = options_.version;
  auto session = OperatorSession::open(std::move(config), impl_->callbacks(), clock_);
  if (!session) return tl::make_unexpected(session.error());
  impl_->session = std::move(*session);
  return {};
}

void RobotLink::open() {
  if (impl_->session) return;
  if (const auto connected = connectToRobot(); !connected) {
    LinkHealth refused;
    refused.state = LinkState::Refused;
    refused.reason = QString::fromStdString(connected.error().message);
    emit health(refused);
  }
}

void RobotLink::close() { impl_->session.reset(); }

std::optional<Stamp> RobotLink::robotNow() const {
  return impl_->session ? impl_->session->toRobotTime(clock_.now()) : std::nullopt;
}

QString RobotLink::clientId() const {
  return impl_->session ? QString::fromStdString(impl_->session->clientId()) : QString{};
}

QString RobotLink::operatorName() const { return QString::fromStdString(options_.operator_name); }

std::uint64_t RobotLink::send(const CommandBody& body) {
  return impl_->session ? impl_->session->send(body) : 0;
}

void RobotLink::startSetpoint(const CommandBody& body, std::uint64_t press) {
  if (impl_->session) impl_->session->hold(body, press);
}

std::uint64_t RobotLink::press() { return impl_->session ? impl_->session->press() : 0; }

void RobotLink::releaseSetpoint(const CommandBody& example) {
  if (impl_->session) impl_->session->release(example);
}

void RobotLink::releaseSetpoints() {
  if (impl_->session) impl_->session->releaseAll();
}

void RobotLink::stop() {
  if (!impl_->session) return;
  impl_->session->stop();
  // Without a link the lane has nothing to report: the press itself is shown all the same.
  impl_->deliverStop(impl_->session->stopReport());
}

}  // namespace kiln::gui
