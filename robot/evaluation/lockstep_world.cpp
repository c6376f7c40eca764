#include "robot/evaluation/lockstep_world.h"

#include <csignal>
#include <fstream>
#include <optional>
#include <vector>

#include <nlohmann/json.hpp>

#include "robot/evaluation/child_process.h"

namespace kiln {

struct LockstepWorld::Impl {
  explicit Impl(const std::string& purpose) : scratch(purpose) {}
  ScratchFolder scratch;
  std::optional<ChildProcess> process;
  std::unique_ptr<SimLink> link;
};

LockstepWorld::LockstepWorld(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
LockstepWorld::~LockstepWorld() = default;

Result<std::unique_ptr<LockstepWorld>> LockstepWorld::start(const std::string& purpose, int seed,
                                                            const std::string& world,
                                                            const Clock& clock) {
  auto impl = std::make_unique<Impl>(purpose);
  const ScratchFolder& scratch = impl->scratch;
  SimLink::Config config;
  config.endpoint = "ipc://" + scratch.file("world");
  config.lockstep = true;
  config.version = KILN_VERSION;
  std::vector<std::string> command{siblingProgram("kiln-sim"),
                                   "--lockstep",
                                   "--seed",
                                   std::to_string(seed),
                                   "--listen",
                                   config.endpoint,
                                   "--truth",
                                   scratch.file("truth.json")};
  if (!world.empty()) command.insert(command.end(), {"--world", world});
  auto process = ChildProcess::start(command, scratch.file("sim.log"));
  if (!process) return tl::make_unexpected(process.error());
  impl->process = std::move(*process);
  auto link = SimLink::connect(config, clock);
  if (!link) return tl::make_unexpected(link.error());
  impl->link = std::move(*link);
  return std::unique_ptr<LockstepWorld>(new LockstepWorld(std::move(impl)));
}

SimLink& LockstepWorld::link() { return *impl_->link; }

Result<nlohmann::json> LockstepWorld::end() {
  impl_->link.reset();  // says bye
  impl_->process->signal(SIGTERM);
  (void)impl_->process->wait(std::chrono::seconds(5));
  std::ifstream in(impl_->scratch.file("truth.json"));
  nlohmann::json truth = nlohmann::json::parse(in, nullptr, false);
  if (!truth.is_object()) {
    return makeError(ErrorCode::NotFound, "kiln-sim left no truth; its last words:\n{}",
                     tailOf(impl_->scratch.file("sim.log"), 6));
  }
  return truth;
}

}  // namespace kiln
