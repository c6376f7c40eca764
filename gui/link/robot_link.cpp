#include "gui/link/robot_link.h"

#include <QTimer>
#include <algorithm>

#include "common/client/operator_session.h"
#include "common/core/bounded_queue.h"
#include "gui/link/inbox.h"
#include "gui/link/jpeg_decoder.h"

namespace kiln::gui {

namespace {
constexpr std::size_t kLogQueue = 2000;
constexpr std::size_t kAckQueue = 200;
constexpr double kLossSmoothing = 0.02;  // about the last 50 status messages
constexpr double kDelaySmoothing = 0.1;
constexpr int kAckShown_ms = 500;  // until the robot's status tells of the latch itself
constexpr int kWarnLevel = 3;

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

std::optional<AckOutcome> outcomeOf(CommandState state) {
  switch (state) {
    case CommandState::Accepted:
      return AckOutcome::Accepted;
    case CommandState::Refused:
      return AckOutcome::Refused;
    case CommandState::Done:
      return AckOutcome::Done;
    case CommandState::Failed:
      return AckOutcome::Failed;
    case CommandState::Cancelled:
      return AckOutcome::Cancelled;
    case CommandState::Sent:
    case CommandState::Unknown:
      return std::nullopt;  // the tracker keeps its own clock
  }
  return std::nullopt;
}

/// Many short values that must not be lost: handed over in batches, the oldest dropped at the
/// limit.
template <class T>
class Batches {
 public:
  Batches(QObject& target, std::size_t capacity, std::function<void(const std::vector<T>&)> deliver)
      : queue_(capacity, DropPolicy::Oldest),
        bell_(target, [this, deliver](const int&) { deliver(queue_.drain()); }) {}
  void put(T value) {
    queue_.push(std::move(value));
    bell_.put(0);
  }

 private:
  BoundedQueue<T> queue_;
  Inbox<int> bell_;
};
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
  Inbox<std::pair<std::shared_ptr<const RobotStatus>, Arrival>> status;
  Inbox<std::shared_ptr<const FsmInfo>> fsm_info;
  Inbox<std::shared_ptr<const FsmStatus>> fsm_status;
  Inbox<std::shared_ptr<const Scene>> scene;
  Inbox<std::vector<MacroInfo>> macros;
  Inbox<PointCloudPtr> cloud;
  Inbox<ThermalImagePtr> thermal;
  Inbox<std::shared_ptr<const HeatDetections>> heat;
  Inbox<RgbImagePtr> head_image, operator_image;
  Batches<LogLine> log;
  Batches<CommandAck> acks;
  double down_s = -1.0, loss = 0.0;
  bool reachable = false;
  std::unique_ptr<JpegDecoder> decoder;
  std::unique_ptr<OperatorSession> session;  // last: its threads call all of the above
};

RobotLink::Impl::Impl(RobotLink& owner)
    : link(owner),
      health(owner, [this](const LinkReport& r) { deliverHealth(r); }),
      stop(owner, [this](const StopReport& r) { deliverStop(r); }),
      hello(owner, [this](const HelloReply& r) { emit link.hello(r); }),
      status(owner,
             [this](const auto& value) {
               noteArrival(value.second);
               emit link.status(value.first);
             }),
      fsm_info(owner, [this](const auto& value) { emit link.fsmInfo(value); }),
      fsm_status(owner, [this](const auto& value) { emit link.fsmStatus(value); }),
      scene(owner, [this](const auto& value) { emit link.scene(value); }),
      macros(owner, [this](const auto& value) { emit link.macros(value); }),
      cloud(owner, [this](const auto& value) { emit link.cloud(value); }),
      thermal(owner, [this](const auto& value) { emit link.thermal(value); }),
      heat(owner, [this](const auto& value) { emit link.heat(value); }),
      head_image(owner, [this](const auto& value) { emit link.image(value); }),
      operator_image(owner, [this](const auto& value) { emit link.image(value); }),
      log(owner, kLogQueue, [this](const std::vector<LogLine>& lines) { emit link.log(lines); }),
      acks(owner, kAckQueue, [this](const std::vector<CommandAck>& batch) {
        for (CommandAck ack : batch) {
          ack.client_id = session ? session->clientId() : std::string{};
          emit link.ack(ack);
        }
      }) {
  decoder = std::make_unique<JpegDecoder>(
      [this](RgbImagePtr image) {
        (image->frame == "rgb" ? head_image : operator_image).put(std::move(image));
      },
      [this](const std::string& text) {
        log.put(LogLine{Stamp{}, kWarnLevel, "station", text});
      });
}

OperatorSession::Callbacks RobotLink::Impl::callbacks() {
  OperatorSession::Callbacks c;
  c.on_link = [this](const LinkReport& r) { health.put(r); };
  c.on_hello = [this](const HelloReply& r) { hello.put(r); };
  c.on_stop = [this](const StopReport& r) { stop.put(r); };
  c.on_command = [this](const CommandUpdate& u) {
    const auto outcome = outcomeOf(u.state);
    if (!outcome) return;
    acks.put(CommandAck{{}, u.nonce, u.command, *outcome, u.code, u.reason, u.lease_holder});
  };
  c.on_status = [this](const RobotStatus& v, const Arrival& a) {
    status.put({std::make_shared<const RobotStatus>(v), a});
  };
  c.on_fsm_info = [this](const FsmInfo& v, const Arrival&) {
    fsm_info.put(std::make_shared<const FsmInfo>(v));
  };
  c.on_fsm_status = [this](const FsmStatus& v, const Arrival&) {
    fsm_status.put(std::make_shared<const FsmStatus>(v));
  };
  c.on_scene = [this](const Scene& v, const Arrival&) {
    scene.put(std::make_shared<const Scene>(v));
  };
  c.on_macros = [this](const std::vector<MacroInfo>& v, const Arrival&) { macros.put(v); };
  c.on_log = [this](const LogBatch& v, const Arrival&) {
    for (const LogLine& line : v.lines) log.put(line);
  };
  c.on_cloud = [this](PointCloudPtr v, const Arrival&) { cloud.put(std::move(v)); };
  c.on_thermal = [this](ThermalImagePtr v, const Arrival&) { thermal.put(std::move(v)); };
  c.on_heat = [this](const HeatDetections& v, const Arrival&) {
    heat.put(std::make_shared<const HeatDetections>(v));
  };
  c.on_jpeg = [this](JpegImagePtr v, const Arrival&) { decoder->put(std::move(v)); };
  c.on_bad_message = [this](const Error& e) {
    log.put(LogLine{Stamp{}, kWarnLevel, "station", e.message});
  };
  return c;
}

void RobotLink::Impl::noteArrival(const Arrival& arrival) {
  for (std::uint64_t i = 0; i < std::min<std::uint64_t>(arrival.lost_before, 50); ++i)
    loss += kLossSmoothing * (1 - loss);
  loss -= kLossSmoothing * loss;
  if (arrival.latency_s <= 0) return;
  down_s = down_s < 0 ? arrival.latency_s : down_s + kDelaySmoothing * (arrival.latency_s - down_s);
}

void RobotLink::Impl::deliverHealth(const LinkReport& r) {
  LinkHealth h;
  h.state = stateOf(r.state);
  h.endpoint = QString::fromStdString(link.options_.endpoint);
  h.reason = QString::fromStdString(r.reason);
  h.rtt_s = r.rtt_s;
  h.down_s = r.clock_known ? std::min(std::max(down_s, 0.0), r.rtt_s) : -1.0;
  h.up_s = r.clock_known ? r.rtt_s - h.down_s : -1.0;
  h.loss = loss;
  h.heard_age_s = std::max(0.0, r.rx_age_s);
  h.robot_hears_age_s = std::max(0.0, r.robot_rx_age_s);
  h.drops = r.drops;
  reachable = h.state == LinkState::Up || h.state == LinkState::Degraded;
  emit link.health(h);
  if (session && session->stopReport().state != StopReport::State::Sent) deliverQuietLane();
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

void RobotLink::startSetpoint(const CommandBody& body) {
  if (impl_->session) impl_->session->hold(body);
}

void RobotLink::releaseSetpoints() {
  if (impl_->session) impl_->session->releaseAll();
}

void RobotLink::stop() {
  if (impl_->session) impl_->session->stop();
}

}  // namespace kiln::gui
