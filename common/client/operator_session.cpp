#include "common/client/operator_session.h"

#include <deque>
#include <mutex>
#include <random>
#include <utility>

#include "common/client/command_tracker.h"
#include "common/client/hold_stream.h"
#include "common/client/link_talk.h"
#include "common/core/text.h"
#include "common/transport/station_end.h"
#include "common/wire/command.h"

namespace kiln {
namespace {

constexpr double kReportPeriod_s = 0.2;

/// The robot would clean the name too; here it must not make a message too long for the socket.
OperatorSession::Config cleaned(OperatorSession::Config config) {
  config.operator_name = printableName(config.operator_name);
  return config;
}

std::string randomClientId() {
  std::random_device random;
  return fmt::format("{:08x}{:08x}", random(), random());
}

std::uint64_t randomKey() {
  std::random_device random;
  return std::uint64_t{random()} << 32 | random() | 1u;
}

}  // namespace

struct OperatorSession::Impl {
  Impl(Config c, Callbacks cb, const Clock& station_clock)
      : config(cleaned(std::move(c))),
        callbacks(std::move(cb)),
        clock(station_clock),
        client_id(randomClientId()),
        talk({kProtocolVersion, config.program_version, client_id, config.operator_name,
              config.role, config.expected_mission_uuid, randomKey()},
             config.degraded_after_s, config.lost_after_s),
        tracker(config.ack_timeout_s),
        holds(config.setpoint_rate_hz, config.hold_ttl_s) {
    auto& on_status = callbacks.topics.on<Topic::RobotStatus>();
    on_status = [this, told = on_status](SharedValueOf<Topic::RobotStatus> status,
                                         const Arrival& arrival) {
      onStatus(*status);
      if (told) told(std::move(status), arrival);
    };
  }

  // link thread
  void onMessage(std::string_view bytes);
  void onHelloReply(const HelloReply& reply);
  void onHeartbeat(const Heartbeat& heartbeat);
  void onAck(const CommandAck& ack);
  void onPublished(Topic topic, const FrameHeader& header, std::string_view payload,
                   std::uint64_t lost);
  void onStatus(const RobotStatus& status);
  void onTick();
  void reportLink(Monotonic::time_point now);
  void setLease(LeaseView view, std::unique_lock<std::mutex>& lock);
  void bad(const Error& error) {
    if (callbacks.on_bad_message) callbacks.on_bad_message(error);
  }

  [[nodiscard]] Result<std::unique_ptr<StopCaller>> connectStopLane(const std::string& address);

  // any thread; the mutex is held
  [[nodiscard]] LinkReport makeReport(Monotonic::time_point now) const;
  [[nodiscard]] std::optional<Command> makeCommand(CommandBody body);
  void finishUpdates(std::unique_lock<std::mutex>& lock);

  Config config;
  Callbacks callbacks;
  const Clock& clock;
  const std::string client_id;

  mutable std::mutex mutex;  // guards what follows, up to the ends
  LinkTalk talk;
  CommandTracker tracker;
  HoldStream holds;
  LeaseView lease;
  std::uint64_t last_nonce = 0;
  std::optional<Monotonic::time_point> reported;
  LinkState reported_state = LinkState::Connecting;
  std::deque<CommandUpdate> updates;  // to be delivered on the link thread

  std::unique_ptr<StationEnd> end;
  std::unique_ptr<StopCaller> stop_caller;
};

Result<std::unique_ptr<OperatorSession>> OperatorSession::open(Config config, Callbacks callbacks,
                                                               const Clock& clock) {
  const auto addresses = parseEndpoint(config.endpoint);
  if (!addresses) return tl::make_unexpected(addresses.error());
  auto impl = std::make_unique<Impl>(std::move(config), std::move(callbacks), clock);
  StationEnd::Options options;
  options.client_id = impl->client_id;
  options.topics = impl->config.topics;
  if (options.topics.empty()) {
    for (const TopicInfo& info : topicTable()) options.topics.push_back(info.topic);
  }
  options.faults = {impl->config.up_loss, impl->config.down_loss, impl->config.up_delay_s,
                    impl->config.fault_seed};
  auto end = StationEnd::connect(*addresses, std::move(options));
  if (!end) return tl::make_unexpected(end.error());
  auto stop_caller = impl->connectStopLane(addresses->stop);
  if (!stop_caller) return tl::make_unexpected(stop_caller.error());
  impl->stop_caller = std::move(*stop_caller);
  impl->end = std::move(*end);
  impl->end->start(
      {[raw = impl.get()](std::string_view bytes) { raw->onMessage(bytes); },
       [raw = impl.get()](Topic topic, const FrameHeader& header, std::string_view payload,
                          std::uint64_t lost) { raw->onPublished(topic, header, payload, lost); },
       [raw = impl.get()](std::string reason) {
         raw->bad({ErrorCode::InvalidInput, std::move(reason)});
       },
       [raw = impl.get()] { raw->onTick(); }});
  return std::unique_ptr<OperatorSession>(new OperatorSession(std::move(impl)));
}

Result<std::unique_ptr<StopCaller>> OperatorSession::Impl::connectStopLane(
    const std::string& address) {
  return StopCaller::connect(address, client_id, config.operator_name,
                             {callbacks.on_stop, callbacks.on_bad_message,
                              [this](std::int64_t robot_ns) {
                                const std::lock_guard lock(mutex);
                                return talk.clock().toStation(robot_ns);
                              }},
                             clock);
}

OperatorSession::OperatorSession(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}

OperatorSession::~OperatorSession() {
  const std::lock_guard lock(impl_->mutex);
  if (!impl_->holds.active()) return;
  for (int i = 0; i < 3; ++i) {
    if (const auto zero = impl_->makeCommand(ReleaseAll{}))
      impl_->end->send(wire::encode(ToRobot{*zero}));
  }
}

// --- link thread: what comes in

void OperatorSession::Impl::onMessage(std::string_view bytes) {
  auto message = wire::decodeToStation(bytes);
  if (!message) return bad(message.error());
  {
    const std::lock_guard lock(mutex);
    talk.heard(bytes.size(), monotonicNow());
  }
  if (const auto* reply = std::get_if<HelloReply>(&*message)) return onHelloReply(*reply);
  if (const auto* heartbeat = std::get_if<Heartbeat>(&*message)) return onHeartbeat(*heartbeat);
  onAck(std::get<CommandAck>(*message));
}

void OperatorSession::Impl::onHelloReply(const HelloReply& reply) {
  {
    std::unique_lock lock(mutex);
    talk.onHelloReply(reply);
    if (!reply.accepted) setLease({}, lock);  // whatever we held there is gone
  }
  if (callbacks.on_hello) callbacks.on_hello(reply);
}

void OperatorSession::Impl::onHeartbeat(const Heartbeat& heartbeat) {
  const std::int64_t received_ns = toNanoseconds(clock.now());
  const std::lock_guard lock(mutex);
  talk.onHeartbeat(heartbeat, received_ns, monotonicNow());
}

void OperatorSession::Impl::onAck(const CommandAck& ack) {
  if (ack.client_id != client_id) return;
  std::unique_lock lock(mutex);
  updates.push_back(tracker.answered(ack, monotonicNow()));
  if (ack.lease_epoch > 0) setLease({true, ack.lease_epoch}, lock);
  finishUpdates(lock);
}

void OperatorSession::Impl::onPublished(Topic topic, const FrameHeader& header,
                                        std::string_view payload, std::uint64_t lost_now) {
  Arrival arrival;
  arrival.received = clock.now();
  arrival.lost_before = lost_now;
  {
    const std::lock_guard lock(mutex);
    talk.heard(payload.size(), monotonicNow());
    talk.onFrame(topic, lost_now, header.dropped_before);
    if (const auto sent = talk.clock().toStation(header.published_ns)) {
      arrival.latency_s = toSeconds(arrival.received - stampFromNanoseconds(*sent));
    }
  }
  const auto done = callbacks.topics.dispatch(topic, payload, arrival);
  if (!done) bad(done.error());
}

void OperatorSession::Impl::onStatus(const RobotStatus& status) {
  std::unique_lock lock(mutex);
  if (status.lease.epoch < lease.epoch) return;  // older than what an acknowledgement has told us
  const bool mine = status.lease.holder_client == client_id;
  setLease({mine, mine ? status.lease.epoch : lease.epoch}, lock);
}

void OperatorSession::Impl::setLease(LeaseView view, std::unique_lock<std::mutex>& lock) {
  const bool changed = view.mine != lease.mine || (view.mine && view.epoch != lease.epoch);
  if (changed && !view.mine) holds.releaseAll();
  lease = view;
  if (!changed || !callbacks.on_lease) return;
  lock.unlock();
  callbacks.on_lease(view);
  lock.lock();
}

// --- link thread: what goes out

void OperatorSession::Impl::onTick() {
  const auto now = monotonicNow();
  std::unique_lock lock(mutex);
  if (const auto word = talk.due(now, toNanoseconds(clock.now()))) end->send(wire::encode(*word));
  for (HoldStream::Setpoint& setpoint : holds.due(now)) {
    // Without a link the setpoint is not sent, and never later.
    if (auto command = makeCommand(std::move(setpoint.body))) {
      command->press = setpoint.press;
      end->send(wire::encode(ToRobot{*command}));
    }
  }
  for (CommandUpdate& update : tracker.expire(now)) updates.push_back(std::move(update));
  finishUpdates(lock);
  lock.unlock();
  reportLink(now);
}

void OperatorSession::Impl::reportLink(Monotonic::time_point now) {
  LinkReport report;
  {
    std::unique_lock lock(mutex);
    report = makeReport(now);
    const bool changed = report.state != reported_state;
    if (!changed && reported && secondsBetween(*reported, now) < kReportPeriod_s) return;
    reported = now;
    reported_state = report.state;
    if (report.state == LinkState::Lost) setLease({}, lock);
  }
  if (callbacks.on_link) callbacks.on_link(report);
}

LinkReport OperatorSession::Impl::makeReport(Monotonic::time_point now) const {
  return talk.report(now, end ? end->droppedSends() : 0);
}

std::optional<Command> OperatorSession::Impl::makeCommand(CommandBody body) {
  const auto issued = talk.commandTime(monotonicNow(), toNanoseconds(clock.now()));
  if (!issued) return std::nullopt;
  return Command{client_id,
                 config.operator_name,
                 ++last_nonce,
                 lease.mine ? lease.epoch : 0,
                 stampFromNanoseconds(*issued),
                 0,
                 std::move(body)};
}

void OperatorSession::Impl::finishUpdates(std::unique_lock<std::mutex>& lock) {
  while (!updates.empty()) {
    const CommandUpdate update = std::move(updates.front());
    updates.pop_front();
    if (!callbacks.on_command) continue;
    lock.unlock();
    callbacks.on_command(update);
    lock.lock();
  }
}

// --- any thread

std::uint64_t OperatorSession::send(CommandBody body) {
  const auto now = monotonicNow();
  const std::lock_guard lock(impl_->mutex);
  const auto command = impl_->makeCommand(body);
  if (command && impl_->end->send(wire::encode(ToRobot{*command}))) {
    impl_->updates.push_back(impl_->tracker.sent(command->nonce, command->body, now));
    return command->nonce;
  }
  LinkReport report = impl_->makeReport(now);
  CommandUpdate update;
  update.nonce = command ? command->nonce : ++impl_->last_nonce;
  update.command = commandName(body);
  update.state = CommandState::Refused;
  update.code = "no_link";
  update.reason = fmt::format("not sent: {}", report.reason.empty()
                                                  ? "the clock offset is not known yet; try again"
                                                  : report.reason);
  impl_->updates.push_back(update);
  return update.nonce;
}

std::uint64_t OperatorSession::press() {
  const std::lock_guard lock(impl_->mutex);
  return impl_->holds.press();
}

void OperatorSession::hold(CommandBody setpoint, std::uint64_t press) {
  const std::lock_guard lock(impl_->mutex);
  impl_->holds.hold(std::move(setpoint), press, monotonicNow());
}

void OperatorSession::release(const CommandBody& example) {
  const std::lock_guard lock(impl_->mutex);
  impl_->holds.release(example);
}

void OperatorSession::releaseAll() {
  const std::lock_guard lock(impl_->mutex);
  impl_->holds.releaseAll();
}

void OperatorSession::stop() {
  releaseAll();
  impl_->stop_caller->press();
}

const std::string& OperatorSession::clientId() const { return impl_->client_id; }

LinkReport OperatorSession::link() const {
  const std::lock_guard lock(impl_->mutex);
  return impl_->makeReport(monotonicNow());
}

LeaseView OperatorSession::lease() const {
  const std::lock_guard lock(impl_->mutex);
  return impl_->lease;
}

StopReport OperatorSession::stopReport() const { return impl_->stop_caller->report(); }

std::optional<Stamp> OperatorSession::toStationTime(Stamp robot) const {
  const std::lock_guard lock(impl_->mutex);
  const auto ns = impl_->talk.clock().toStation(toNanoseconds(robot));
  return ns ? std::optional(stampFromNanoseconds(*ns)) : std::nullopt;
}

std::optional<Stamp> OperatorSession::toRobotTime(Stamp station) const {
  const std::lock_guard lock(impl_->mutex);
  const auto ns = impl_->talk.clock().toRobot(toNanoseconds(station));
  return ns ? std::optional(stampFromNanoseconds(*ns)) : std::nullopt;
}

}  // namespace kiln
