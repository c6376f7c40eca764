#include "robot/sim/fault_catalog.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iterator>

#include <fmt/ranges.h>

namespace kiln::sim {
namespace {

const FaultKind* kindOf(const std::string& name) {
  const auto kinds = faultKinds();
  const auto it = std::find_if(kinds.begin(), kinds.end(),
                               [&](const FaultKind& kind) { return name == kind.name; });
  return it == kinds.end() ? nullptr : &*it;
}

Result<double> number(const std::string& text, const std::string& whole) {
  try {
    std::size_t used = 0;
    const double value = std::stod(text, &used);
    if (used == text.size() && std::isfinite(value)) return value;
  } catch (const std::exception&) {  // std::stod reports bad text in no other way
  }
  return makeError(ErrorCode::InvalidInput,
                   "'{}' in fault '{}' is no number; write NAME[=NUMBER,...]@SECONDS[:SECONDS]",
                   text, whole);
}

Result<void> readNumbers(const std::string& list, const std::string& whole,
                         std::vector<double>& out) {
  for (std::size_t begin = 0; begin <= list.size();) {
    const std::size_t end = std::min(list.find(',', begin), list.size());
    const auto value = number(list.substr(begin, end - begin), whole);
    if (!value) return tl::make_unexpected(value.error());
    out.push_back(*value);
    begin = end + 1;
  }
  return {};
}

}  // namespace

std::span<const FaultKind> faultKinds() {
  static const std::vector<FaultKind> kinds = {
      {"pump_blocked_left", "", {}, false, "the left pump turns and moves no water"},
      {"pump_blocked_right", "", {}, false, "the right pump turns and moves no water"},
      {"pump_blocked", "", {}, false, "both pumps turn and move no water"},
      {"thermal_freeze", "", {}, false, "the thermal camera repeats its last picture"},
      {"lidar_dropout", "", {}, false, "no scans arrive"},
      {"camera_freeze", "", {}, false, "no operator pictures arrive"},
      {"arm_obstacle", "", {}, false, "a padded box of 0.2 m appears in the way of the moving arm"},
      {"protective_stop", "", {}, false, "the arm's own controller stops it"},
      {"kidnap",
       "X_M,Y_M,YAW_DEG",
       {1, 0, 0},
       false,
       "the robot is put elsewhere by that much, in its own frame, and nobody tells it"},
      {"cupboard_moved",
       "X_M,Y_M,YAW_DEG",
       {0.5, 0.9, 20},
       false,
       "the cupboard stands elsewhere by that much, in map"},
      {"people",
       "COUNT",
       {2},
       false,
       "so many people walk about, 1.1 m/s; they keep out of the robot's way"},
      {"person_in_way",
       "X_M,Y_M",
       {6.6, 0},
       false,
       "one person steps to that place in map from the side, stands there, and steps back at the "
       "end; does not keep out of the robot's way"},
      {"view_blocked",
       "AZIMUTH_DEG",
       {0},
       false,
       "boards half a metre from the LiDAR hide half its view about that azimuth"},
      {"runaway",
       "FACTOR,OFFSET_MPS",
       {2.5, 0},
       false,
       "the motor controllers drive factor x commanded + offset; encoders stay honest; only "
       "missing setpoints stop an offset"},
      {"magnet_broken", "MAGNET", {1}, false, "that magnet (1 to 8) takes no current"},
      {"storage_jammed",
       "COMPARTMENT",
       {1},
       false,
       "something holds that compartment (1: the front one) where it is"},
      {"fire_box_misplaced",
       "DISTANCE_M,PLACE",
       {0.2, 0},
       true,
       "a fire box stands that far from its configured place, direction by seed; place 0 is the "
       "burning one, 1 the first"},
  };
  return kinds;
}

Result<void> checkFault(const FaultConfig& fault) {
  const FaultKind* kind = kindOf(fault.name);
  if (kind == nullptr) {
    std::vector<std::string> known;
    for (const FaultKind& k : faultKinds()) known.emplace_back(k.name);
    return makeError(ErrorCode::InvalidInput, "unknown fault '{}'; known are {}", fault.name,
                     fmt::join(known, ", "));
  }
  if (!(fault.at_s >= 0) || !(fault.duration_s > 0)) {
    return makeError(
        ErrorCode::InvalidInput,
        "fault '{}' begins at {} s for {} s; give a start of 0 or more and a duration above 0",
        fault.name, fault.at_s, fault.duration_s);
  }
  if (kind->from_start && fault.at_s > 0) {
    return makeError(ErrorCode::InvalidInput,
                     "fault '{}' is part of the world from its start; write @0 instead of @{}",
                     fault.name, fault.at_s);
  }
  if (fault.values.size() > kind->defaults.size()) {
    return makeError(ErrorCode::InvalidInput, "fault '{}' has {} numbers; it takes {}", fault.name,
                     fault.values.size(),
                     kind->defaults.empty() ? std::string("none") : kind->values);
  }
  return {};
}

double faultValue(const FaultConfig& fault, std::size_t i) {
  return i < fault.values.size() ? fault.values[i] : kindOf(fault.name)->defaults[i];
}

std::string faultHelp() {
  std::string out = "Faults:\n";
  for (const FaultKind& kind : faultKinds()) {
    const std::string values = kind.defaults.empty() ? "" : fmt::format("[={}]", kind.values);
    fmt::format_to(std::back_inserter(out), "  {}{}\n      {}", kind.name, values, kind.doc);
    if (!kind.defaults.empty())
      fmt::format_to(std::back_inserter(out), " (default {})", fmt::join(kind.defaults, ","));
    out += '\n';
  }
  return out;
}

void FaultConfig::visit(ConfigArchive& a) {
  a.field("name", name, "which fault");
  a.field("at_s", at_s, "s", 0, 1e9, "simulated time of its begin");
  a.field("duration_s", duration_s, "s", 0, 1e9, "how long it lasts");
  a.field("values", values, "", -1e6, 1e6, "its numbers; those left out have their defaults",
          false);
}

Result<FaultConfig> FaultConfig::parse(const std::string& text) {
  FaultConfig fault;
  const std::size_t at = text.find('@');
  if (at == std::string::npos) {
    return makeError(ErrorCode::InvalidInput,
                     "fault '{}' has no time; write NAME[=NUMBER,...]@SECONDS[:SECONDS]", text);
  }
  const std::size_t equals = text.find('=');
  fault.name = text.substr(0, std::min(at, equals));
  if (equals < at) {
    const auto ok = readNumbers(text.substr(equals + 1, at - equals - 1), text, fault.values);
    if (!ok) return tl::make_unexpected(ok.error());
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

}  // namespace kiln::sim
