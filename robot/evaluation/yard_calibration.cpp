#include "robot/evaluation/yard_calibration.h"

#include <array>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include <nlohmann/json.hpp>
#include <yaml-cpp/yaml.h>

#include "common/config/resources.h"
#include "common/core/atomic_file.h"
#include "common/core/log.h"
#include "robot/evaluation/child_process.h"
#include "robot/evaluation/lockstep_world.h"

namespace kiln {
namespace {

using nlohmann::json;

const std::array kYards{Yard{"robot_model/bob.yaml", "calibration"},
                        Yard{"robot_model/mario.yaml", "calibration_mario"}};
constexpr const char* kMap = "config/arena_calibration.yaml";
constexpr const char* kJet = "config/spray_calibration.yaml";
constexpr Duration kStep = std::chrono::milliseconds(8);

/// The routine on the devices of a fresh world, as far as the robot sees it.
struct Routine {
  CalibrationResult found;
  double simulated_s = 0.0;
};

Result<Routine> calibrateBy(const Yard& of, SimLink& link, ManualClock& clock) {
  auto robot = loadResource<RobotGeometry>(of.robot);
  if (!robot) return tl::make_unexpected(robot.error());
  auto yard = loadResource<ArenaMap>(kMap);
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
  const auto has = [&]<class Device>(DeviceKind kind, Device& device) -> Device* {
    return link.world().devices.contains(kind) ? &device : nullptr;
  };
  CalibrationRoutineConfig config;
  config.nozzle.jet = *jet;
  auto found =
      calibrateRobot(config, *robot, {*yard, *plate},
                     {link.arm(), link.lidar(), clock, step, has(DeviceKind::Pumps, link.pumps()),
                      has(DeviceKind::ThermalCamera, link.thermalCamera()),
                      has(DeviceKind::OperatorCamera, link.operatorCamera())});
  if (!found) return tl::make_unexpected(found.error());
  return Routine{std::move(*found), toSeconds(clock.now())};
}

std::string contentOf(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

/// FNV-1a.
class Fingerprint {
 public:
  void add(const std::string& bytes) {
    for (const char c : bytes) hash_ = (hash_ ^ static_cast<unsigned char>(c)) * 0x100000001b3ull;
  }
  [[nodiscard]] std::string hex() const { return fmt::format("{:016x}", hash_); }

 private:
  std::uint64_t hash_ = 0xcbf29ce484222325ull;
};

/// Changes with everything that a calibration depends on: programs, yard and robot.
std::string fingerprint(const Yard& yard) {
  static const Fingerprint programs = [] {
    Fingerprint out;
    for (const char* program : {"kiln-sim", "kiln-eval"})
      out.add(contentOf(siblingProgram(program)));
    return out;
  }();
  Fingerprint all = programs;
  for (const std::string& resource :
       {yard.robot, std::string(kMap), std::string(kJet), "worlds/" + yard.world + ".yaml"})
    if (const auto path = resourcePath(resource); path) all.add(contentOf(*path));
  return all.hex();
}

}  // namespace

Result<Yard> yardOf(const std::string& world) {
  if (world.empty()) return kYards.front();
  std::string path = world;
  if (!std::filesystem::exists(path)) {
    auto shipped = resourcePath("worlds/" + world + ".yaml");
    if (!shipped) return tl::make_unexpected(shipped.error());
    path = *shipped;
  }
  std::string robot, those;
  try {
    robot = YAML::LoadFile(path)["robot"].as<std::string>(kYards.front().robot);
  } catch (const YAML::Exception& e) {
    return makeError(ErrorCode::InvalidInput, "{}: {}", path, e.what());
  }
  for (const Yard& yard : kYards) {
    if (yard.robot == robot) return yard;
    those += " " + yard.robot;
  }
  return makeError(ErrorCode::InvalidInput,
                   "{} has no yard in which it could be calibrated; these have:{}", robot, those);
}

Result<RobotGeometry> nominalRobot() { return loadResource<RobotGeometry>(kYards.front().robot); }

Result<YardCalibration> calibrateInYard(const Yard& yard, int seed) {
  ManualClock clock;
  auto world = LockstepWorld::start("calibrate", seed, yard.world, clock);
  if (!world) return tl::make_unexpected(world.error());
  auto done = calibrateBy(yard, (*world)->link(), clock);
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

Result<std::string> calibrationOf(const Yard& yard, int seed, const std::string& folder) {
  const std::string path = fmt::format("{}/seed-{}-{}.yaml", folder, seed, fingerprint(yard));
  const auto robot = loadResource<RobotGeometry>(yard.robot);
  if (!robot) return tl::make_unexpected(robot.error());
  if (std::filesystem::exists(path) && loadCalibrated(path, *robot)) return path;
  auto done = calibrateInYard(yard, seed);
  if (!done) return tl::make_unexpected(done.error());
  std::error_code failed;
  std::filesystem::create_directories(folder, failed);
  if (auto written = writeFileAtomically(path, calibrationFile(*done, seed), false); !written)
    return tl::make_unexpected(written.error());
  return path;
}

}  // namespace kiln
