#include "gui/ctl/console.h"

#include <cstdio>
#include <utility>

#include "gui/ctl/json_view.h"
#include "gui/ctl/signals.h"

namespace kiln::ctl {
namespace {

constexpr double kPoll_s = 0.02;   // signals set a flag only, so every wait looks at it
constexpr double kAnswer_s = 3.0;  // beyond the session's own 1 s, which makes a command UNKNOWN

/// How to get control from who has it, if that is what it was refused for.
std::string_view hintFor(const CommandUpdate& update) {
  return update.code == "lease_held" || update.code == "no_lease" ? " (--take-over asks)" : "";
}

constexpr double kTakeOver_s = 12.0;  // the holder is asked for 10 s

bool ended(const CommandUpdate& update) {
  return update.state != CommandState::Sent && update.state != CommandState::Accepted;
}

}  // namespace

Console::~Console() { session_.reset(); }

OperatorSession::Callbacks Console::callbacks() {
  OperatorSession::Callbacks callbacks;
  const auto keep = [this](auto& slot) {
    return [this, &slot](const auto& value, const Arrival&) {
      const std::lock_guard lock(mutex_);
      slot = *value;
      changed_.notify_all();
    };
  };
  callbacks.topics.on<Topic::RobotStatus>() = keep(status_);
  callbacks.topics.on<Topic::FsmStatus>() = keep(fsm_);
  callbacks.topics.on<Topic::Localization>() = keep(localization_);
  callbacks.topics.on<Topic::Macros>() = keep(macros_);
  callbacks.topics.on<Topic::MissionInfo>() = keep(mission_);
  callbacks.on_link = [this](const LinkReport&) { changed_.notify_all(); };
  callbacks.on_lease = [this](const LeaseView&) { changed_.notify_all(); };
  callbacks.on_stop = [this](const StopReport&) { changed_.notify_all(); };
  callbacks.on_command = [this](const CommandUpdate& update) {
    const std::lock_guard lock(mutex_);
    fates_[update.nonce] = update;
    if (update.state == CommandState::Refused && !refusal_) refusal_ = update;
    changed_.notify_all();
  };
  return callbacks;
}

bool Console::open() {
  OperatorSession::Config config;
  config.endpoint = options_.endpoint;
  config.operator_name = options_.name;
  config.program_version = KILN_VERSION;
  config.role = options_.role;
  config.topics = {Topic::RobotStatus, Topic::FsmStatus, Topic::MissionInfo, Topic::Macros,
                   Topic::Localization};
  auto session = OperatorSession::open(std::move(config), callbacks(), clock_);
  if (!session) {
    fail(kNoLink, session.error().message);
    return false;
  }
  session_ = std::move(*session);
  return true;
}

bool Console::connect() {
  if (!open()) return false;
  const bool ready = waitFor(
      [&] {
        const LinkReport link = session_->link();
        const bool usable = link.state == LinkState::Connected || link.state == LinkState::Degraded;
        return link.state == LinkState::Refused ||
               (usable && link.clock_known && status_.has_value());
      },
      options_.connect_s);
  const LinkReport link = session_->link();
  if (ready && link.state != LinkState::Refused) return true;
  fail(kNoLink, fmt::format("{}: {}", options_.endpoint,
                            link.reason.empty() ? "connected, but no status arrives from the robot"
                                                : link.reason));
  return false;
}

bool Console::takeControl() {
  const auto nonce = session_->send(AcquireLease{options_.take_over});
  const auto update = waitForEnd(nonce, options_.take_over ? kTakeOver_s : kAnswer_s);
  if (update && update->state == CommandState::Done &&
      waitFor([&] { return session_->lease().mine; }, kAnswer_s)) {
    const std::lock_guard lock(mutex_);
    refusal_.reset();
    return true;
  }
  if (update) {
    printRefusal(toJson(*update),
                 fmt::format("no control: {}{}", update->reason, hintFor(*update)));
  } else {
    fail(kRefused, "no control: no answer from the robot");
  }
  return false;
}

void Console::giveControlBack() {
  if (!session_->lease().mine) return;
  static_cast<void>(waitForEnd(session_->send(ReleaseLease{}), kAnswer_s, false));
}

int Console::run(CommandBody body) {
  const auto update = waitForEnd(session_->send(std::move(body)), kAnswer_s);
  if (!update) return fail(kRefused, "interrupted before the robot answered");
  const std::string text =
      update->reason.empty()
          ? fmt::format("{}: {}", update->command, toString(update->state))
          : fmt::format("{}: {}: {}", update->command, toString(update->state), update->reason);
  if (update->state == CommandState::Done || update->state == CommandState::Accepted) {
    print(toJson(*update), text);
    return kDone;
  }
  printRefusal(toJson(*update), fmt::format("{}{}", text, hintFor(*update)));
  return kRefused;
}

std::optional<CommandUpdate> Console::waitForEnd(std::uint64_t nonce, double limit_s,
                                                 bool heed_signals) {
  static_cast<void>(waitFor(
      [&] {
        const auto fate = fates_.find(nonce);
        return fate != fates_.end() && ended(fate->second);
      },
      limit_s, heed_signals));
  const std::lock_guard lock(mutex_);
  const auto fate = fates_.find(nonce);
  if (fate == fates_.end()) return std::nullopt;
  return fate->second;
}

bool Console::waitFor(const std::function<bool()>& condition, double limit_s, bool heed_signals) {
  const Stamp start = clock_.now();
  std::unique_lock lock(mutex_);
  while (!condition()) {
    if ((heed_signals && signalled()) || toSeconds(clock_.now() - start) > limit_s) return false;
    changed_.wait_for(lock, fromSeconds(kPoll_s));
  }
  return true;
}

void Console::pauseFor(double seconds) {
  static_cast<void>(waitFor([] { return false; }, seconds));
}

void Console::sleepThroughSignals(double seconds) {
  std::unique_lock lock(mutex_);
  changed_.wait_for(lock, fromSeconds(seconds));
}

void Console::print(const nlohmann::json& object, const std::string& text) const {
  std::puts(options_.json
                ? object.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace).c_str()
                : text.c_str());
  std::fflush(stdout);
}

void Console::printRefusal(const nlohmann::json& object, const std::string& text) const {
  if (options_.json)
    print(object, "");
  else
    std::fprintf(stderr, "kilnctl: %s\n", text.c_str());
}

int Console::fail(int code, const std::string& reason, const std::string& error_code) {
  printRefusal(
      {{"outcome", "failed"},
       {"code", error_code.empty() ? (code == kNoLink ? "no_link" : "failed") : error_code},
       {"reason", reason}},
      reason);
  return code;
}

RobotStatus Console::status() const {
  const std::lock_guard lock(mutex_);
  return status_.value_or(RobotStatus{});
}

std::optional<FsmStatus> Console::fsm() const {
  const std::lock_guard lock(mutex_);
  return fsm_;
}

std::optional<LocalizationStatus> Console::localization() const {
  const std::lock_guard lock(mutex_);
  return localization_;
}

std::vector<MacroInfo> Console::macros() const {
  const std::lock_guard lock(mutex_);
  return macros_.value_or(std::vector<MacroInfo>{});
}

std::optional<MissionInfo> Console::mission() {
  static_cast<void>(waitFor([this] { return mission_.has_value(); }, kLatched_s));
  const std::lock_guard lock(mutex_);
  return mission_;
}

std::optional<CommandUpdate> Console::takeRefusal() {
  const std::lock_guard lock(mutex_);
  return std::exchange(refusal_, std::nullopt);
}

bool Console::lost() const {
  const LinkState state = session_->link().state;
  return state != LinkState::Connected && state != LinkState::Degraded;
}

}  // namespace kiln::ctl
