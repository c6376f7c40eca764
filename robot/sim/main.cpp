#include <csignal>
#include <limits>
#include <map>

#include <fmt/format.h>

#include "common/config/command_line.h"
#include "common/config/resources.h"
#include "common/core/log.h"
#include "common/core/scheduling.h"
#include "robot/sim/fault_catalog.h"
#include "robot/sim/world_server.h"

namespace {

std::atomic<bool> stop_requested{false};
static_assert(std::atomic<bool>::is_always_lock_free, "written by a signal handler");
void onSignal(int) { stop_requested.store(true); }

constexpr int kBadInput = 2;

struct Options {
  std::string world = "fire";
  std::uint64_t seed = 1;
  std::vector<std::string> faults;
  std::vector<std::string> without;
  kiln::sim::WorldServer::Config server;
};

std::vector<std::string> deviceNames() {
  std::vector<std::string> names;
  for (const kiln::DeviceKind kind : kiln::kDeviceKinds) names.emplace_back(kiln::shortName(kind));
  return names;
}

void addOptions(CLI::App& app, Options& o) {
  o.server.endpoint = "ipc:///tmp/kiln-sim";
  o.server.version = KILN_VERSION;
  app.set_version_flag("--version", std::string("kiln-sim ") + KILN_VERSION);
  app.add_option("--world", o.world, "World: a YAML file, or a name in resources/worlds")
      ->capture_default_str();
  app.add_option("--seed", o.seed, "What is drawn: fire, errors, noise")
      ->capture_default_str()
      ->check(kiln::wholeUpTo(std::numeric_limits<std::uint64_t>::max()));
  app.add_option("--listen", o.server.endpoint, "ipc://PATH or tcp://127.0.0.1:PORT")
      ->capture_default_str();
  app.add_flag("--lockstep", o.server.lockstep,
               "Move only as the robot says (deterministic) instead of in real time");
  app.add_option("--truth", o.server.truth_path,
                 "Write what truly happened here (JSON) at the end");
  app.add_option("--truth-trace", o.server.trace_path, "Write true poses here (JSON lines, 10 Hz)");
  app.add_option("--fault", o.faults,
                 "NAME[=NUMBER,...]@SECONDS[:SECONDS], begin and duration; may be repeated");
  app.add_option("--without", o.without, "The robot lacks this device; may be repeated")
      ->check(CLI::IsMember(deviceNames()));
  app.footer(kiln::sim::faultHelp());
}

kiln::Result<kiln::sim::WorldConfig> loadWorld(const Options& o) {
  std::string path = o.world;
  if (path.find('/') == std::string::npos && !path.ends_with(".yaml")) {
    const auto found = kiln::resourcePath("worlds/" + path + ".yaml");
    if (!found) return tl::make_unexpected(found.error());
    path = *found;
  }
  auto config = kiln::sim::WorldConfig::load(path);
  if (!config) return config;
  for (const std::string& text : o.faults) {
    const auto fault = kiln::sim::FaultConfig::parse(text);
    if (!fault) return tl::make_unexpected(fault.error());
    config->faults.push_back(*fault);
  }
  return config;
}

int fail(const kiln::Error& error) {
  fmt::print(stderr, "kiln-sim: {}\n", error.message);
  return kBadInput;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("kiln-sim: the world, its devices and its truth");
  Options options;
  addOptions(app, options);
  if (const auto status = kiln::parseCommandLine(app, argc, argv)) return *status;

  struct sigaction action {};
  action.sa_handler = onSignal;  // no SA_RESTART: poll returns at once
  ::sigaction(SIGINT, &action, nullptr);
  ::sigaction(SIGTERM, &action, nullptr);

  // Before the world starts its threads: the LiDAR's inherits this.
  if (!options.server.lockstep) kiln::runBeforeOthers();
  const auto config = loadWorld(options);
  if (!config) return fail(config.error());
  auto world =
      kiln::sim::World::create(*config, options.seed, {.render_colour = options.server.lockstep});
  if (!world) return fail(world.error());
  options.server.devices = (*world)->devices();
  for (const std::string& device : options.without)
    options.server.devices.erase(*kiln::deviceNamed(device));
  const kiln::SteadyClock clock;
  auto server = kiln::sim::WorldServer::create(options.server, **world, clock);
  if (!server) return fail(server.error());
  kiln::logger("sim")->info("world '{}', seed {}, {} on {}", config->name, options.seed,
                            options.server.lockstep ? "lockstep" : "real time",
                            options.server.endpoint);
  const auto ended = (*server)->run(stop_requested);
  return ended ? 0 : fail(ended.error());
}
