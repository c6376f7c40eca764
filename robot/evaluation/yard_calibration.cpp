#include "robot/evaluation/yard_calibration.h"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include <nlohmann/json.hpp>

#include "common/config/resources.h"
#include "common/core/atomic_file.h"
#include "common/core/log.h"
#include "robot/evaluation/child_process.h"
#include "robot/evaluation/lockstep_world.h"

namespace kiln {
namespace {

using nlohmann::json;

constexpr const char* kRobot = "robot_model/bob.yaml";
constexpr const char* kYard = "config/arena_calibration.yaml";
constexpr const char* kJet = "config/spray_calibration.yaml";
constexpr Duration kStep = std::chrono::milliseconds(8);

/// The routine on the devices of a fresh world, as far as the robot sees it.
struct Routine {
  CalibrationResult found;
  double simulated_s = 0.0;
};

Result<Routine> calibrateBy(SimLink& link, ManualClock& clock) {
  auto robot = nominalRobot();
  if (!robot) return tl::make_unexpected(robot.error());
  auto yard = loadResource<ArenaMap>(kYard);
  if (!yard) return tl::make_unexpected(yard.error());
  auto plate = loadFireSite(*yard);
  if (!plate) return tl::make_unexpected(plate.error());
  auto jet = loadResource<SprayCalibration>(kJet);
  if (!jet) return tl::make_unexpected(jet.error());
  clock.advanceTo(link.world().now);
  const auto step = [&]() -> Result<void> {
    clock.advanceBy(kStep);
    return link.advanceTo(clock.now());
  };
  CalibrationRoutineConfig config;
  config.nozzle.jet = *jet;
  auto found = calibrateRobot(config, *robot, {*yard, *plate},
                              {link.arm(), link.pumps(), link.lidar(), link.thermalCamera(),
                               link.operatorCamera(), clock, step});
  if (!found) return tl::make_unexpected(found.error());
  return Routine{std::move(*found), toSeconds(clock.now())};
}

std::string contentOf(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

/// Changes with everything that a calibration depends on: programs, yard and robot.
std::string fingerprint() {
  std::uint64_t hash = 0xcbf29ce484222325ull;  // FNV-1a
  const auto add = [&hash](const std::string& bytes) {
    for (const char c : bytes) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3ull;
  };
  for (const char* program : {"kiln-sim", "kiln-eval"}) add(contentOf(siblingProgram(program)));
  for (const char* resource : {kRobot, kYard, kJet, "worlds/calibration.yaml"})
    if (const auto path = resourcePath(resource); path) add(contentOf(*path));
  return fmt::format("{:016x}", hash);
}

}  // namespace

Result<RobotGeometry> nominalRobot() { return loadResource<RobotGeometry>(kRobot); }

Result<YardCalibration> calibrateInYard(int seed) {
  ManualClock clock;
  auto world = LockstepWorld::start("calibrate", seed, "calibration", clock);
  if (!world) return tl::make_unexpected(world.error());
  auto done = calibrateBy((*world)->link(), clock);
  const auto truth = (*world)->end();
  if (!done) {
    return makeError(done.error().code, "seed {}: {}; collisions: {}", seed, done.error().message,
                     truth ? truth->value("collisions", json::array()).dump() : "?");
  }
  if (!truth) return tl::make_unexpected(truth.error());
  return YardCalibration{std::move(done->found), done->simulated_s, truth->dump()};
}

std::string calibrationFile(const YardCalibration& done, int seed) {
  RobotCalibration calibration = done.found.calibration;
  calibration.note = fmt::format("seed {} of the calibration yard", seed);
  for (const std::string& line : done.found.report) calibration.note += "; " + line;
  return "# Mounting of the sensors as `kiln-eval calibrate` found it; for kiln-robotd "
         "--calibration.\n" +
         dumpConfig(calibration);
}

std::string calibrationCache() {
  if (const char* cache = std::getenv("XDG_CACHE_HOME"); cache != nullptr && *cache != 0)
    return std::string(cache) + "/kiln/calibration";
  if (const char* home = std::getenv("HOME"); home != nullptr && *home != 0)
    return std::string(home) + "/.cache/kiln/calibration";
  return std::filesystem::temp_directory_path() / "kiln-calibration";
}

Result<std::string> calibrationOf(int seed, const std::string& folder) {
  static const std::string key = fingerprint();
  const std::string path = fmt::format("{}/seed-{}-{}.yaml", folder, seed, key);
  const auto robot = nominalRobot();
  if (!robot) return tl::make_unexpected(robot.error());
  if (std::filesystem::exists(path) && loadCalibrated(path, *robot)) return path;
  auto done = calibrateInYard(seed);
  if (!done) return tl::make_unexpected(done.error());
  std::error_code failed;
  std::filesystem::create_directories(folder, failed);
  if (auto written = writeFileAtomically(path, calibrationFile(*done, seed), false); !written)
    return tl::make_unexpected(written.error());
  return path;
}

}  // namespace kiln
