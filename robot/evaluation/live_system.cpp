#include "robot/evaluation/live_system.h"

#include <csignal>
#include <fstream>
#include <sstream>

namespace kiln {

LiveSystem::LiveSystem(int seed)
    : scratch_("live"),
      operator_clock_(std::chrono::milliseconds(seed * 1237 % 6001 - 3000),
                      seed % 2 == 0 ? 20.0 : -20.0) {}

Result<std::unique_ptr<LiveSystem>> LiveSystem::start(int seed,
                                                      const std::vector<std::string>& robot_args,
                                                      const std::vector<std::string>& world_args,
                                                      const std::string& programs) {
  const auto program = [&](const std::string& name) {
    return programs.empty() ? siblingProgram(name) : programs + "/" + name;
  };
  std::unique_ptr<LiveSystem> live(new LiveSystem(seed));
  const std::string socket = "ipc://" + live->scratch_.file("world");
  std::vector<std::string> world{program("kiln-sim"),
                                 "--seed",
                                 std::to_string(seed),
                                 "--listen",
                                 socket,
                                 "--truth",
                                 live->scratch_.file("truth.json")};
  world.insert(world.end(), world_args.begin(), world_args.end());
  auto world_process = ChildProcess::start(world, live->scratch_.file("sim.log"));
  if (!world_process) return tl::make_unexpected(world_process.error());
  live->world_ = std::make_unique<ChildProcess>(std::move(*world_process));
  std::vector<std::string> robot{program("kiln-robotd"),
                                 "--sim",
                                 socket,
                                 "--state-dir",
                                 live->scratch_.file("state"),
                                 "--listen",
                                 live->linkEndpoint()};
  robot.insert(robot.end(), robot_args.begin(), robot_args.end());
  auto robot_process = ChildProcess::start(robot, live->scratch_.file("robotd.log"));
  if (!robot_process) return tl::make_unexpected(robot_process.error());
  live->robot_ = std::make_unique<ChildProcess>(std::move(*robot_process));
  return live;
}

Result<std::unique_ptr<ScriptedOperator>> LiveSystem::connectOperator(
    const std::string& name) const {
  auto person =
      ScriptedOperator::connect(linkEndpoint(), name, std::chrono::seconds(15), &operator_clock_);
  if (person) return person;
  return makeError(person.error().code, "{}; the daemon's last words:\n{}", person.error().message,
                   tailOf(scratch_.file("robotd.log"), 6));
}

Result<std::string> LiveSystem::finish() {
  robot_->signal(SIGTERM);
  (void)robot_->wait(std::chrono::seconds(5));
  world_->signal(SIGTERM);
  (void)world_->wait(std::chrono::seconds(5));
  std::ifstream in(scratch_.file("truth.json"));
  std::ostringstream text;
  text << in.rdbuf();
  if (text.str().empty()) {
    return makeError(ErrorCode::NotFound, "kiln-sim left no truth report; its last words:\n{}",
                     tailOf(scratch_.file("sim.log"), 6));
  }
  return text.str();
}

}  // namespace kiln
