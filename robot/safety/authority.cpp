#include "robot/safety/authority.h"

#include <utility>

#include "robot/safety/gate_rules.h"

namespace kiln {
namespace {

constexpr std::size_t kMaxRefusalKeys = 256;

CommandAck ackFor(const Command& command, AckOutcome outcome) {
  CommandAck ack;
  ack.client_id = command.client_id;
  ack.nonce = command.nonce;
  ack.command = commandName(command.body);
  ack.outcome = outcome;
  return ack;
}

}  // namespace

void Authority::Config::visit(ConfigArchive& a) {
  a.section("lease", lease, "who may command");
  a.section("gate", gate, "which commands pass");
  a.section("dead_man", dead_man, "hold-to-run");
  a.field("refusal_period_s", refusal_period_s, "s", 0.04, 2.0,
          "a refused setpoint stream is answered this often");
}

Authority::Authority(Config config)
    : config_(config), lease_(config.lease), gate_(config.gate), dead_man_(config.dead_man) {}

Authority::Step Authority::step(const std::vector<ReceivedCommand>& received,
                                const std::vector<OperatorPeer>& peers, Handler& handler,
                                Stamp now) {
  Step step;
  dead_man_.expire(now);
  const GateSituation found = handler.situation(now);
  if (found.stop_generation != stop_seen_) {
    stop_seen_ = found.stop_generation;
    const std::string why = fmt::format("STOP by {}", found.stop_source);
    lease_.revoke(why);
    invalidate();
    if (!stop_said_) step.events.push_back(why);  // not each of a stream of STOPs
    stop_said_ = true;
  }
  stop_said_ = stop_said_ && found.stop_latched;
  for (const OperatorPeer& peer : peers) lease_.heard(peer.client_id, peer.last_heard);
  applyEvents(handler, now, step);
  for (const ReceivedCommand& command : received) handle(command, handler, now, step);
  applyEvents(handler, now, step);
  if (const auto released = dead_man_.takeReleased(now); !released.empty())
    handler.onReleased(released, now);
  return step;
}

GateDecision Authority::judge(const ReceivedCommand& received, const LeaseStatus& lease,
                              GateSituation situation, Stamp now) {
  const Command& command = received.command;
  situation.anything_held = situation.anything_held || dead_man_.anyHeld(now);
  GateDecision decision = gate_.decide(received, lease, situation, now);
  if (!decision.accepted) {
    const bool only_this_message = decision.code == "replayed" || decision.code == "out_of_order" ||
                                   decision.code == "bad_number" || decision.code == "too_old" ||
                                   decision.code == "in_future";
    dead_man_.refused(command, only_this_message);
  } else if (isSetpoint(command.body) && !dead_man_.mayFeed(command)) {
    return gate::refuse("press_over", "this press has ended; let go and press again");
  }
  return decision;
}

void Authority::handle(const ReceivedCommand& received, Handler& handler, Stamp now, Step& step) {
  const Command& command = received.command;
  const LeaseStatus lease = lease_.status(now);
  const GateDecision decision = judge(received, lease, handler.situation(now), now);
  if (!decision.accepted) {
    if (isSetpoint(command.body) && !answerRefusal(command, decision.code, now)) return;
    CommandAck ack = ackFor(command, AckOutcome::Refused);
    ack.code = decision.code;
    ack.reason = decision.reason;
    ack.lease_holder = lease.holder_name;
    step.acks.push_back(std::move(ack));
    return;
  }
  if (std::holds_alternative<AcquireLease>(command.body) ||
      std::holds_alternative<ReleaseLease>(command.body)) {
    answerLease(received, handler, now, step);
    return;
  }
  if (isSetpoint(command.body)) dead_man_.feed(command, received.received);
  if (auto ack = handler.execute({command, received.received, decision.speed_scale}, now))
    step.acks.push_back(std::move(*ack));
}

void Authority::answerLease(const ReceivedCommand& received, Handler& handler, Stamp now,
                            Step& step) {
  const Command& command = received.command;
  const bool acquire = std::holds_alternative<AcquireLease>(command.body);
  const std::uint64_t epoch_before = lease_.status(now).epoch;
  const Lease::Requester who{command.client_id, command.operator_name, received.role,
                             command.nonce};
  const Lease::Answer answer =
      acquire ? lease_.acquire(who, std::get<AcquireLease>(command.body).take_over, now)
              : lease_.release(command.client_id, now);
  CommandAck ack = ackFor(command, answer.outcome == Lease::Outcome::Granted ? AckOutcome::Done
                                   : answer.outcome == Lease::Outcome::Asked ? AckOutcome::Accepted
                                                                             : AckOutcome::Refused);
  const LeaseStatus lease = lease_.status(now);
  ack.code = answer.code;
  ack.reason = answer.reason;
  ack.lease_holder = lease.holder_name;
  if (acquire && answer.outcome == Lease::Outcome::Granted) ack.lease_epoch = lease.epoch;
  step.acks.push_back(std::move(ack));
  const bool released = !acquire && answer.outcome == Lease::Outcome::Granted;
  if (!released && lease.epoch == epoch_before) return;
  invalidate();
  step.events.push_back(
      fmt::format("{} {}", command.operator_name, acquire ? "took control" : "gave control back"));
  if (released) handler.onLeaseLost(now);
}

void Authority::applyEvents(Handler& handler, Stamp now, Step& step) {
  for (const Lease::Event& event : lease_.tick(now)) {
    switch (event.kind) {
      case Lease::Event::Kind::Lost:
        invalidate();
        handler.onLeaseLost(now);
        step.events.push_back(fmt::format("{} lost control: {}", event.who.name, event.reason));
        break;
      case Lease::Event::Kind::Granted:
      case Lease::Event::Kind::Denied: {
        const bool granted = event.kind == Lease::Event::Kind::Granted;
        CommandAck ack;
        ack.client_id = event.who.client_id;
        ack.nonce = event.who.nonce;
        ack.command = commandName(AcquireLease{});
        ack.outcome = granted ? AckOutcome::Done : AckOutcome::Refused;
        ack.code = granted ? "" : "denied";
        ack.reason = event.reason;
        ack.lease_holder = lease_.status(now).holder_name;
        ack.lease_epoch = granted ? lease_.status(now).epoch : 0;
        step.acks.push_back(std::move(ack));
        if (granted) invalidate();
        step.events.push_back(fmt::format("{} {}: {}", event.who.name,
                                          granted ? "took control" : "was denied control",
                                          event.reason));
        break;
      }
    }
  }
}

void Authority::invalidate() {
  dead_man_.releaseAll();
  epoch_.bump();
}

bool Authority::answerRefusal(const Command& command, const std::string& code, Stamp now) {
  if (last_refusal_.size() > kMaxRefusalKeys) last_refusal_.clear();
  const std::string key =
      fmt::format("{}/{}/{}", command.client_id, commandName(command.body), code);
  const auto [entry, first] = last_refusal_.try_emplace(key, now);
  if (!first && now - entry->second < fromSeconds(config_.refusal_period_s)) return false;
  entry->second = now;
  return true;
}

}  // namespace kiln
