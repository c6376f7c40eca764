#include "robot/sim/world_config.h"

#include <cmath>
#include <sstream>

#include <fmt/ranges.h>

#include "robot/hal/device_set.h"
#include "robot/sim/fault_catalog.h"

namespace kiln::sim {
void PhysicsConfig::visit(ConfigArchive& a) {
  a.field("step_s", step_s, "s", 0.0005, 0.01, "physics step");
  a.field("contact_slack_s", contact_slack_s, "s", 0, 0.1,
          "contact time constant = 2 steps + this");
  a.field("friction", friction, "", 0.1, 2, "sliding friction of wheels, walls and furniture");
}

void DistractorConfig::visit(ConfigArchive& a) {
  a.field("name", name, "for messages");
  a.section("center", center, "pose of the box centre in map");
  a.field("size_m", size_m, "m", 0.0005, 10, "full lengths");
  a.field("min_c", min_c, "degC", -20, 200, "coolest by seed");
  a.field("max_c", max_c, "degC", -20, 200, "warmest by seed");
  a.field("solid", solid, "false: a warm patch that only the thermal camera sees");
}

void WarmBoardConfig::visit(ConfigArchive& a) {
  a.field("box", box, "name of a wall of the arena");
  a.field("min_c", min_c, "degC", -20, 200, "coolest by seed");
  a.field("max_c", max_c, "degC", -20, 200, "warmest by seed");
  a.field("water_c", water_c, "degC", 0, 100, "the water that lands on it");
  a.field("share", share, "", 0, 1, "of the way to the water's temperature, by one drop");
  a.field("splash_m", splash_m, "m", 0.001, 0.1, "radius that a drop wets");
  a.field("warm_again_s", warm_again_s, "s", 0.1, 1e4, "time constant");
  a.field("cell_m", cell_m, "m", 0.002, 0.1, "of the grid that keeps the wetness");
}

void WorldConfig::visit(ConfigArchive& a) {
  a.field("name", name, "for the operator");
  a.field("arena", arena, "nominal arena, below resources/");
  a.field("robot", robot, "nominal robot, below resources/");
  a.field("without", without,
          "devices that the robot lacks, as kiln-sim --without, separated by spaces");
  a.field("approach", approach, "ramp and edge of the arena; false: flat ground");
  a.field("device_period_s", device_period_s, "s", 0.002, 0.1,
          "a report each so often in real time");
  a.section("physics", physics, "rigid bodies and contacts");
  a.section("base", base, "hub wheels and steering");
  a.section("arm", arm, "the arm's controller");
  a.section("water", water, "tanks, pumps and jet");
  a.section("lidar", lidar, "VLP-16");
  a.section("thermal", thermal, "Lepton 3.5");
  a.section("camera", camera, "operator camera");
  a.section("head_camera", head_camera, "colour camera in the head");
  a.section("sun", sun, "where it stands");
  a.section("perturbation", perturbation, "true world against configured world, by seed");
  a.section("fire", fire, "the fire places");
  a.section("wall", wall, "bricks, gripper and storage");
  a.field("collision_force_n", collision_force_n, "N", 0, 1e3,
          "contacts above this count as collisions");
  a.list("distractors", distractors, "warm things that are not the fire");
  a.list("warm_boards", warm_boards, "heated walls on which water shows in the infrared");
  a.list("faults", faults, "scripted faults");
}

Result<void> WorldConfig::validate() const {
  std::istringstream words(without);
  for (std::string word; words >> word;) {
    if (deviceNamed(word)) continue;
    std::vector<std::string_view> known;
    for (const DeviceKind kind : kDeviceKinds) known.push_back(shortName(kind));
    return makeError(ErrorCode::InvalidInput, "without: '{}' is no device; known are {}", word,
                     fmt::join(known, ", "));
  }
  if (sun.max_elevation_deg < sun.min_elevation_deg)
    return makeError(ErrorCode::InvalidInput,
                     "sun: max_elevation_deg {} is below min_elevation_deg {}",
                     sun.max_elevation_deg, sun.min_elevation_deg);
  for (const FaultConfig& fault : faults) {
    if (auto ok = checkFault(fault); !ok) return ok;
  }
  for (const DistractorConfig& d : distractors) {
    if (d.max_c < d.min_c) {
      return makeError(ErrorCode::InvalidInput, "distractor '{}': max_c {} is below min_c {}",
                       d.name, d.max_c, d.min_c);
    }
  }
  for (const WarmBoardConfig& b : warm_boards) {
    if (b.max_c < b.min_c) {
      return makeError(ErrorCode::InvalidInput, "warm board '{}': max_c {} is below min_c {}",
                       b.box, b.max_c, b.min_c);
    }
  }
  const double steps = device_period_s / physics.step_s;
  if (std::fabs(steps - std::round(steps)) > 1e-6) {
    return makeError(ErrorCode::InvalidInput,
                     "device_period_s {} is no multiple of physics step_s {}", device_period_s,
                     physics.step_s);
  }
  return {};
}

Result<WorldConfig> WorldConfig::load(const std::string& path) {
  WorldConfig config;
  if (auto ok = loadConfig(path, config); !ok) return tl::make_unexpected(ok.error());
  if (auto ok = config.validate(); !ok) {
    return makeError(ErrorCode::InvalidInput, "{}: {}", path, ok.error().message);
  }
  return config;
}

}  // namespace kiln::sim
