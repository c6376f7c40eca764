#include "robot/evaluation/scripted_operator.h"

#include <algorithm>
#include <cmath>

namespace kiln {
namespace {
constexpr std::size_t kKeptAnswers = 256;
}  // namespace

template <class Change>
void ScriptedOperator::update(Change change) {
  {
    const std::lock_guard lock(mutex_);
    change(view_);
  }
  changed_.notify_all();
}

OperatorSession::Callbacks ScriptedOperator::callbacks() {
  OperatorSession::Callbacks on;
  on.on_link = [this](const LinkReport& link) { update([&](View& v) { v.link = link; }); };
  on.on_command = [this](const CommandUpdate& u) {
    update([&](View& v) {
      v.last_command = u;
      v.answers[u.nonce] = u;
      if (v.answers.size() > kKeptAnswers) v.answers.erase(v.answers.begin());
    });
  };
  on.on_stop = [this](const StopReport& stop) { update([&](View& v) { v.stop = stop; }); };
  on.on_lease = [this](const LeaseView& lease) { update([&](View& v) { v.lease = lease; }); };
  on.topics.on<Topic::RobotStatus>() = [this](const auto& status, const Arrival&) {
    update([&](View& v) { v.status = *status; });
  };
  on.topics.on<Topic::Scene>() = [this](const auto& scene, const Arrival&) {
    update([&](View& v) { v.scene = *scene; });
  };
  on.topics.on<Topic::MissionStream>() = [this](const auto& detail, const Arrival&) {
    update([&](View& v) { v.stream = *detail; });
  };
  return on;
}

Result<std::unique_ptr<ScriptedOperator>> ScriptedOperator::connect(const std::string& endpoint,
                                                                    const std::string& name,
                                                                    Duration limit,
                                                                    const Clock* clock) {
  std::unique_ptr<ScriptedOperator> person(new ScriptedOperator);
  OperatorSession::Config config;
  config.endpoint = endpoint;
  config.operator_name = name;
  config.program_version = KILN_VERSION;
  auto session = OperatorSession::open(config, person->callbacks(),
                                       clock != nullptr ? *clock : person->clock_);
  if (!session) return tl::make_unexpected(session.error());
  person->session_ = std::move(*session);
  auto connected = person->waitFor("the robot's status", limit, [](const View& v) {
    return v.status.has_value() && v.link.clock_known;
  });
  if (!connected) return tl::make_unexpected(connected.error());
  return person;
}

Result<void> ScriptedOperator::waitFor(const std::string& what, Duration limit,
                                       const std::function<bool(const View&)>& condition) {
  std::unique_lock lock(mutex_);
  if (!changed_.wait_for(lock, limit, [&] { return condition(view_); })) {
    return makeError(ErrorCode::Timeout, "waited {:.1f} s in vain for {}", toSeconds(limit), what);
  }
  return {};
}

Result<void> ScriptedOperator::command(CommandBody body) {
  const std::string name(commandName(body));
  const std::uint64_t nonce = session_->send(std::move(body));
  const auto answered = [&](const View& v) {
    const auto found = v.answers.find(nonce);
    return found != v.answers.end() && found->second.state != CommandState::Sent;
  };
  if (auto waited = waitFor("the answer to " + name, std::chrono::seconds(3), answered); !waited)
    return waited;
  const CommandUpdate update = view().answers.at(nonce);
  if (update.state == CommandState::Accepted || update.state == CommandState::Done) return {};
  return makeError(ErrorCode::Refused, "{} {}: {}", name, toString(update.state), update.reason);
}

Result<void> ScriptedOperator::takeOver() {
  if (auto lease = command(AcquireLease{}); !lease) return lease;
  if (auto held =
          waitFor("the lease", std::chrono::seconds(2), [](const View& v) { return v.lease.mine; });
      !held) {
    return held;
  }
  if (auto mode = command(SetMode{Mode::Teleop}); !mode) return mode;
  return waitFor("TELEOP", std::chrono::seconds(2),
                 [](const View& v) { return v.status && v.status->mode == Mode::Teleop; });
}

Result<void> ScriptedOperator::holdWhile(
    const std::string& what, Duration limit,
    const std::function<std::optional<CommandBody>(const View&)>& setpoint) {
  const Stamp deadline = clock_.now() + limit;
  const std::uint64_t press = session_->press();
  while (clock_.now() < deadline) {
    const auto wish = setpoint(view());
    if (!wish) {
      session_->releaseAll();
      return {};
    }
    session_->hold(*wish, press);
    std::unique_lock lock(mutex_);
    changed_.wait_for(lock, std::chrono::milliseconds(40));
  }
  session_->releaseAll();
  return makeError(ErrorCode::Timeout, "{}: not done after {:.0f} s", what, toSeconds(limit));
}

Result<void> ScriptedOperator::driveTo(const Pose2& goal, double tolerance_m) {
  constexpr double kTurnTolerance_rad = 0.015;
  return holdWhile("driving by hand", std::chrono::seconds(60),
                   [&](const View& v) -> std::optional<CommandBody> {
                     const Pose2 error = inverse(v.status->X_map_base) * goal;  // in base
                     const double distance = std::hypot(error.x_m, error.y_m);
                     if (distance < tolerance_m && std::abs(error.yaw_rad) < kTurnTolerance_rad)
                       return std::nullopt;
                     // A careful hand: full stick far away, little near the goal.
                     const double speed = std::clamp(0.9 * distance, 0.03, 1.0);
                     const double scale = distance > 1e-6 ? speed / distance : 0.0;
                     JogBase jog;
                     if (distance >= tolerance_m)
                       jog.twist = {error.x_m * scale, error.y_m * scale, 0.0};
                     jog.twist.wz_radps = std::clamp(1.5 * error.yaw_rad, -0.6, 0.6);
                     return jog;
                   });
}

ScriptedOperator::View ScriptedOperator::view() const {
  const std::lock_guard lock(mutex_);
  return view_;
}

}  // namespace kiln
