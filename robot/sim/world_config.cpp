#include "robot/sim/world_config.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/ranges.h>

namespace kiln::sim {
namespace {

constexpr std::array<const char*, 8> kFaults = {
    "pump_blocked_left", "pump_blocked_right", "pump_blocked",    "thermal_freeze",
    "lidar_dropout",     "arm_obstacle",       "protective_stop", "camera_freeze"};

Result<void> checkFault(const FaultConfig& fault) {
  if (std::find(kFaults.begin(), kFaults.end(), fault.name) == kFaults.end()) {
    return makeError(ErrorCode::InvalidInput, "unknown fault '{}'; known are {}", fault.name,
                     fmt::join(kFaults, ", "));
  }
  if (!(fault.at_s >= 0) || !(fault.duration_s > 0)) {
    return makeError(
        ErrorCode::InvalidInput,
        "fault '{}' begins at {} s for {} s; give a start of 0 or more and a duration above 0",
        fault.name, fault.at_s, fault.duration_s);
  }
  return {};
}

Result<double> number(const std::string& text, const std::string& whole) {
  try {
    std::size_t used = 0;
    const double value = std::stod(text, &used);
    if (used == text.size() && std::isfinite(value)) return value;
  } catch (const std::exception&) {  // std::stod reports bad text in no other way
  }
  return makeError(ErrorCode::InvalidInput,
                   "'{}' in fault '{}' is no number; write NAME@SECONDS[:SECONDS]", text, whole);
}

}  // namespace

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

void FaultConfig::visit(ConfigArchive& a) {
  a.field("name", name, "which fault");
  a.field("at_s", at_s, "s", 0, 1e9, "simulated time of its begin");
  a.field("duration_s", duration_s, "s", 0, 1e9, "how long it lasts");
}

Result<FaultConfig> FaultConfig::parse(const std::string& text) {
  FaultConfig fault;
  const std::size_t at = text.find('@');
  fault.name = text.substr(0, at);
  if (at == std::string::npos) {
    return makeError(ErrorCode::InvalidInput,
                     "fault '{}' has no time; write NAME@SECONDS[:SECONDS]", text);
  }
  const std::size_t colon = text.find(':', at);
  const auto begin =
      number(text.substr(at + 1, colon == std::string::npos ? colon : colon - at - 1), text);
  if (!begin) return tl::make_unexpected(begin.error());
  fault.at_s = *begin;
  if (colon != std::string::npos) {
    const auto duration = number(text.substr(colon + 1), text);
    if (!duration) return tl::make_unexpected(duration.error());
    fault.duration_s = *duration;
  }
  if (const auto ok = checkFault(fault); !ok) return tl::make_unexpected(ok.error());
  return fault;
}

void WorldConfig::visit(ConfigArchive& a) {
  a.field("name", name, "for the operator");
  a.field("arena", arena, "nominal arena, below resources/");
  a.field("robot", robot, "nominal robot, below resources/");
  a.field("device_period_s", device_period_s, "s", 0.002, 0.1,
          "a report each so often in real time");
  a.section("physics", physics, "rigid bodies and contacts");
  a.section("base", base, "hub wheels and steering");
  a.section("arm", arm, "the arm's controller");
  a.section("water", water, "tanks, pumps and jet");
  a.section("lidar", lidar, "VLP-16");
  a.section("thermal", thermal, "Lepton 3.5");
  a.section("camera", camera, "operator camera");
  a.section("perturbation", perturbation, "true world against configured world, by seed");
  a.section("fire", fire, "the fire places");
  a.field("collision_force_n", collision_force_n, "N", 0, 1e3,
          "contacts above this count as collisions");
  a.list("distractors", distractors, "warm things that are not the fire");
  a.list("faults", faults, "scripted faults");
}

Result<void> WorldConfig::validate() const {
  for (const FaultConfig& fault : faults) {
    if (auto ok = checkFault(fault); !ok) return ok;
  }
  for (const DistractorConfig& d : distractors) {
    if (d.max_c < d.min_c) {
      return makeError(ErrorCode::InvalidInput, "distractor '{}': max_c {} is below min_c {}",
                       d.name, d.max_c, d.min_c);
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
