#include "tests/system/two_ends.h"

#include <atomic>

#include <gtest/gtest.h>
#include <unistd.h>

#include "common/core/check.h"

namespace kiln::test {

TempFolder::TempFolder() {
  static std::atomic<int> count{0};
  path_ =
      std::filesystem::temp_directory_path() / fmt::format("kiln-link-{}-{}", ::getpid(), ++count);
  std::filesystem::create_directories(path_);
}

TempFolder::~TempFolder() {
  std::error_code ec;
  std::filesystem::remove_all(path_, ec);
}

LinkedRobot::LinkedRobot(const std::string& endpoint, std::string version, std::string mission) {
  OperatorLink::Config config;
  config.endpoint = endpoint;
  auto opened = OperatorLink::open(
      config, {std::move(version), Environment::Sim, std::move(mission)}, clock, stop);
  KILN_CHECK(opened.has_value(), opened ? "" : opened.error().message);
  link = std::move(*opened);
  base_situation.mode = Mode::Teleop;
  base_situation.view_age_s = 0.1;
  this->mission.actuators = {{kPumps, "Both pumps"}};
}

void LinkedRobot::tick() {
  const Stamp now = clock.now();
  Authority::Step step = authority.step(link->takeCommands(), link->operators(), *this, now);
  for (const CommandAck& ack : step.acks) link->acknowledge(ack);
  events.insert(events.end(), step.events.begin(), step.events.end());
  RobotStatus status;
  status.stamp = now;
  status.lease = authority.lease(now);
  status.stop.latched = stop.latched();
  link->publish(status);
}

GateSituation LinkedRobot::situation(Stamp) const {
  GateSituation found = base_situation;
  found.mission = &mission;
  found.stop_latched = stop.latched();
  found.stop_generation = stop.generation();
  found.stop_source = stop.source();
  return found;
}

std::optional<CommandAck> LinkedRobot::execute(const Authority::Accepted& a, Stamp) {
  accepted.push_back(a);
  if (const auto* clear = std::get_if<ClearStop>(&a.command.body))
    (void)stop.clear(clear->generation);
  if (isSetpoint(a.command.body)) return std::nullopt;
  CommandAck ack;
  ack.client_id = a.command.client_id;
  ack.nonce = a.command.nonce;
  ack.command = commandName(a.command.body);
  ack.outcome = AckOutcome::Done;
  return ack;
}

LinkedOperator::LinkedOperator(OperatorSession::Config config) {
  OperatorSession::Callbacks callbacks;
  const auto count = [this](Topic topic) {
    const std::lock_guard lock(mutex);
    ++received[topic];
  };
  callbacks.on_command = [this](const CommandUpdate& update) {
    const std::lock_guard lock(mutex);
    fates_[update.nonce] = update;
    updates_.push_back(update);
  };
  callbacks.topics.on<Topic::RobotStatus>() = [this, count](const auto& status, const Arrival&) {
    count(Topic::RobotStatus);
    const std::lock_guard lock(mutex);
    status_ = *status;
  };
  callbacks.topics.on<Topic::FsmInfo>() = [this, count](const auto& info, const Arrival&) {
    count(Topic::FsmInfo);
    const std::lock_guard lock(mutex);
    fsm_info = *info;
  };
  callbacks.topics.on<Topic::Cloud>() = [this, count](PointCloudPtr value, const Arrival&) {
    count(Topic::Cloud);
    const std::lock_guard lock(mutex);
    cloud = std::move(value);
  };
  callbacks.on_bad_message = [](const Error& error) { ADD_FAILURE() << error; };
  auto opened = OperatorSession::open(std::move(config), std::move(callbacks), clock);
  KILN_CHECK(opened.has_value(), opened ? "" : opened.error().message);
  session = std::move(*opened);
}

CommandUpdate LinkedOperator::fate(std::uint64_t nonce) const {
  const std::lock_guard lock(mutex);
  const auto found = fates_.find(nonce);
  return found != fates_.end() ? found->second : CommandUpdate{};
}

std::vector<CommandUpdate> LinkedOperator::updates() const {
  const std::lock_guard lock(mutex);
  return updates_;
}

std::optional<RobotStatus> LinkedOperator::status() const {
  const std::lock_guard lock(mutex);
  return status_;
}

OperatorSession::Config operatorConfig(const std::string& endpoint, const std::string& name) {
  OperatorSession::Config config;
  config.endpoint = endpoint;
  config.operator_name = name;
  config.program_version = "0.1.0";
  return config;
}

bool tickUntil(LinkedRobot& robot, const std::function<bool()>& condition, double limit_s) {
  std::mutex idle;
  std::condition_variable_any never;
  const Stamp start = robot.clock.now();
  while (toSeconds(robot.clock.now() - start) < limit_s) {
    robot.tick();
    if (condition()) return true;
    std::unique_lock lock(idle);
    never.wait_for(lock, std::chrono::milliseconds(5));  // the tick period; nobody notifies
  }
  return false;
}

bool connected(LinkedRobot& robot, LinkedOperator& op) {
  return tickUntil(robot, [&] {
    const LinkReport link = op.link();
    return link.state == LinkState::Connected && link.clock_known;
  });
}

bool takeControl(LinkedRobot& robot, LinkedOperator& op) {
  if (!connected(robot, op)) return false;
  op.session->send(AcquireLease{});
  return tickUntil(robot, [&] { return op.session->lease().mine; });
}

}  // namespace kiln::test
