#include "robot/app/preflight.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/ranges.h>

namespace kiln {
namespace {

Check ok(std::string name, std::string detail) {
  return {std::move(name), true, std::move(detail)};
}
Check fail(std::string name, std::string detail, std::string action) {
  return {std::move(name), false, std::move(detail), std::move(action)};
}
Check warn(std::string name, std::string detail, std::string action) {
  return {std::move(name), true, std::move(detail), std::move(action), true};
}

Check ageCheck(const std::string& name, std::optional<double> age_s, double limit_s,
               const std::string& advice) {
  if (!age_s) return fail(name, "no data yet", advice);
  if (*age_s > limit_s) return fail(name, fmt::format("no data for {:.1f} s", *age_s), advice);
  return ok(name, fmt::format("{:.2f} s old", std::max(0.0, *age_s)));
}

Check devicesCheck(const PreflightInputs& in) {
  if (in.devices_connected && !in.lacking.empty()) {
    std::vector<std::string_view> names;
    for (const DeviceKind device : in.lacking) names.push_back(toString(device));
    return fail("Devices",
                fmt::format("this mission needs {}, which this robot does not have",
                            fmt::join(names, " and ")),
                "start another mission");
  }
  if (in.devices_connected) return ok("Devices", "connected");
  return fail("Devices", "no connection", "is kiln-sim running, or the robot's power on?");
}

Check armSafetyCheck(const PreflightInputs& in) {
  const std::string mode(toString(in.arm_safety));
  if (in.arm_safety == ArmSafetyMode::Normal) return ok("Arm safety", mode);
  if (in.arm_safety == ArmSafetyMode::Reduced)
    return warn("Arm safety", mode, "the arm yields at 100 N; is reduced mode wanted?");
  return fail("Arm safety", mode, "look at the arm, then release it by hand");
}

Check lidarCheck(const PreflightInputs& in, const PreflightLimits& limits) {
  Check age = ageCheck("LiDAR", in.lidar_age_s, limits.lidar_age_s, "check its cable and power");
  if (!age.ok || in.lidar_defects.text.empty()) return age;
  age.detail += "; " + in.lidar_defects.text;
  if (in.lidar_defects.missing_fraction <= limits.lidar_missing) return age;
  return warn("LiDAR", age.detail, "clouds have holes: check its cable, or record again");
}

Check perceptionCheck(const PreflightInputs& in, const PreflightLimits& limits) {
  const std::string name = "Perception";
  if (const std::string owed = lateProduct(in, limits); !owed.empty())
    return fail(name, owed, "restart the daemon; if it stays, the machine is too slow");
  return ok(name, in.cloud_age_s ? fmt::format("cloud {:.2f} s old", std::max(0.0, *in.cloud_age_s))
                                 : std::string("no cloud yet"));
}

/// What would make an edge of the tree appear.
std::string adviceForEdge(const std::string& edge) {
  if (edge == "odom -> base") return "the wheels do not report: check the wheel controllers";
  if (edge == "base -> flange")
    return "the arm does not report its joints: check the arm controller and its mounting in the "
           "geometry file";
  if (edge == "map -> odom") return "the position is not known: set the robot's pose on the map";
  return "state this mounting in the robot's geometry file";
}

Check transformsCheck(const PreflightInputs& in) {
  if (in.missing_edges.empty())
    return ok("Transforms", fmt::format("{} of {}", in.tree_edges, in.tree_edges));
  const std::string found = in.missing_edges.size() == 1
                                ? in.missing_edges[0] + " is missing"
                                : fmt::format("{} are missing", fmt::join(in.missing_edges, ", "));
  return fail("Transforms", found, adviceForEdge(in.missing_edges.front()));
}

Check clocksCheck(const PreflightInputs& in, const PreflightLimits& limits) {
  double worst_s = 0.0;
  std::string waiting;
  for (const ClockReading& clock : in.clocks) {
    if (!clock.error_s) {
      waiting = clock.of;
      continue;
    }
    if (!(std::abs(*clock.error_s) <= limits.clock_error_s)) {
      return fail("Clocks",
                  fmt::format("{} is {:.0f} ms {}", clock.of, 1e3 * std::abs(*clock.error_s),
                              *clock.error_s < 0 ? "ahead" : "behind"),
                  "restart what is named; if it stays, synchronise its clock with the robot's");
    }
    worst_s = std::max(worst_s, std::abs(*clock.error_s));
  }
  if (!waiting.empty()) return warn("Clocks", waiting + " is not measured yet", "wait a second");
  return ok("Clocks", fmt::format("{} clocks within {:.0f} ms", in.clocks.size(),
                                  std::max(1.0, std::ceil(1e3 * worst_s))));
}

Check pumpCurrentCheck(const PreflightInputs& in, const PreflightLimits& limits) {
  const std::string name = "Pump current";
  if (!in.pumps) return fail(name, "no data yet", "check the pump controller");
  constexpr std::array kSides{"left", "right"};
  const auto& current_a = in.pumps->current_a;
  const std::string found = fmt::format("{:.1f} and {:.1f} A", current_a[0], current_a[1]);
  for (std::size_t i = 0; i < 2; ++i) {
    if (!std::isfinite(current_a[i]))
      return fail(name, fmt::format("the {} pump's is not a number", kSides[i]),
                  "check the current sensor and its wiring");
    if (in.pumps->duty[i] <= 0.0 && current_a[i] > limits.pump_idle_a)
      return fail(name, fmt::format("{} pump draws {:.1f} A at rest", kSides[i], current_a[i]),
                  "its switch is stuck or the sensor is off: cut the pump's power and look");
  }
  if (in.pumps->heartbeat_lost)
    return fail(name, "the board has cut the pumps", "restart the pump controller");
  const bool resting = in.pumps->duty[0] <= 0.0 && in.pumps->duty[1] <= 0.0;
  return ok(name, found + (resting ? " at rest" : ", running"));
}

Check limitsCheck(const PreflightInputs& in) {
  const std::string name = "Controller limits";
  if (!in.reported_beyond_limit.empty())
    return fail(name, in.reported_beyond_limit,
                "drive it back by hand; if it is not there, check the device's zero");
  const LimitRow* clamped = nullptr;
  for (const LimitRow& row : in.limits) {
    if (row.kept()) continue;
    if (!row.clamped)
      return fail(name, row.text(), fmt::format("correct {} in the robot's config", row.key));
    if (!clamped) clamped = &row;
  }
  if (clamped)
    return warn(name, clamped->text(), "held by the controller; correct it in the robot's config");
  return ok(name, fmt::format("{} kept", in.limits.size()));
}

Check positionCheck(const PreflightInputs& in) {
  if (in.pose_health == PoseHealth::Good) return ok("Position", "good");
  return fail("Position", std::string(toString(in.pose_health)),
              "is the robot in its start zone? else set its pose on the map");
}

Check mapCheck(const PreflightInputs& in, const PreflightLimits& limits) {
  const std::string name = "Map against scan";
  if (!in.map_in_use)
    return warn(name, "odometry alone, as configured", "drive a few metres at most");
  if (!in.map_fit) {
    return fail(name, in.match_failure.empty() ? "no scan matched yet" : in.match_failure,
                "right map and start pose? else set the robot's pose on the map");
  }
  const std::string found = fmt::format(
      "{:.0f} % fits, {:.0f} mm rms", 100.0 * in.map_fit->inlier_fraction, 1e3 * in.map_fit->rms_m);
  if (!(in.map_fit->inlier_fraction >= limits.map_inliers))
    return fail(name, found, "is this the right map? else set the robot's pose on the map");
  if (!(in.map_fit->inlier_fraction >= limits.map_inliers_good) ||
      !(in.map_fit->rms_m <= limits.map_rms_m))
    return warn(name, found, "look at cloud and map in the scene: what stands elsewhere?");
  return ok(name, found);
}

Check fenceCheck(const PreflightInputs& in) {
  if (!in.fence_room_m)
    return fail("Geofence", "none", "give the arena's file its geofence, then restart");
  if (!(*in.fence_room_m >= 0.0))
    return fail("Geofence", fmt::format("the robot reaches {:.2f} m over it", -*in.fence_room_m),
                "drive it back in by hand, or set its pose on the map");
  return ok("Geofence", fmt::format("{:.1f} m of room", *in.fence_room_m));
}

Check batteryCheck(const PreflightInputs& in, const PreflightLimits& limits) {
  const std::string found = fmt::format("{:.1f} V", in.battery_v);
  if (in.battery_v >= limits.battery_min_v) return ok("Battery", found);
  return fail("Battery", found, "change the battery");
}

Check diskCheck(const PreflightInputs& in, const PreflightLimits& limits) {
  if (!in.disk_free_gb)
    return warn("Disk", "cannot be read", "does the state folder exist and belong to the daemon?");
  const std::string found = fmt::format("{:.1f} GB free", *in.disk_free_gb);
  if (*in.disk_free_gb < limits.disk_min_gb)
    return fail("Disk", found, "make room: delete old recordings in the state folder");
  if (*in.disk_free_gb < in.recording_needs_gb)
    return warn("Disk", found, "too little to record this run: delete old recordings");
  return ok("Disk", found);
}

Check storageCheck(const PreflightInputs& in) {
  if (in.storage_ok) return ok("Storage", "writable");
  return fail("Storage", "the checkpoint cannot be written",
              "make room, and check who owns the state folder");
}

}  // namespace

void PreflightLimits::visit(ConfigArchive& a) {
  a.field("device_age_s", device_age_s, "s", 0.01, 5, "oldest allowed arm, base or pump state");
  a.field("lidar_age_s", lidar_age_s, "s", 0.1, 10, "oldest allowed LiDAR scan");
  a.field("lidar_missing", lidar_missing, "", 0, 1, "share of LiDAR packets that may be missing");
  a.field("product_age_s", product_age_s, "s", 0.2, 10,
          "oldest allowed cloud while the LiDAR delivers");
  a.field("battery_min_v", battery_min_v, "V", 0, 60, "start no mission below");
  a.field("clock_error_s", clock_error_s, "s", 0.001, 1,
          "largest error of a station's or device's clock");
  a.field("pump_idle_a", pump_idle_a, "A", 0.05, 20, "a pump at rest draws less");
  a.field("map_inliers", map_inliers, "", 0, 1, "a map that explains less of the scan is wrong");
  a.field("map_inliers_good", map_inliers_good, "", 0, 1, "and one that explains less is doubtful");
  a.field("map_rms_m", map_rms_m, "m", 0.001, 1, "doubtful above, of what it explains");
  a.field("disk_min_gb", disk_min_gb, "GB", 0, 10000, "start no mission below");
}

std::vector<Check> preflight(const PreflightInputs& in, const PreflightLimits& limits) {
  std::vector<Check> rows{
      devicesCheck(in),
      ageCheck("Arm", in.arm_age_s, limits.device_age_s, "check the arm controller"),
      armSafetyCheck(in),
      ageCheck("Base", in.base_age_s, limits.device_age_s, "check the wheel controllers")};
  if (in.has_pumps) {
    rows.push_back(
        ageCheck("Pumps", in.pumps_age_s, limits.device_age_s, "check the pump controller"));
    rows.push_back(pumpCurrentCheck(in, limits));
  }
  for (Check& row : std::vector<Check>{
           lidarCheck(in, limits), perceptionCheck(in, limits), transformsCheck(in),
           clocksCheck(in, limits), limitsCheck(in), positionCheck(in), fenceCheck(in),
           mapCheck(in, limits), batteryCheck(in, limits), diskCheck(in, limits), storageCheck(in)})
    rows.push_back(std::move(row));
  return rows;
}

std::string lateProduct(const PreflightInputs& in, const PreflightLimits& limits) {
  if (!in.lidar_age_s || *in.lidar_age_s > limits.lidar_age_s) return {};
  if (!in.cloud_age_s) return "no cloud yet although the LiDAR delivers";
  if (*in.cloud_age_s <= limits.product_age_s) return {};
  return fmt::format("no cloud for {:.1f} s although the LiDAR delivers", *in.cloud_age_s);
}

std::string silentLidar(const PreflightInputs& in, const PreflightLimits& limits) {
  if (!in.lidar_age_s || *in.lidar_age_s <= limits.lidar_age_s) return {};
  return fmt::format("no scan for {:.1f} s", *in.lidar_age_s);
}

Check writersCheck(const std::vector<ActuatorWriter>& actuators, Mode mode) {
  const char* program = mode == Mode::Teleop ? "macro" : "mission";
  std::string found;
  for (const auto& [actuator, writer] : actuators)
    found += fmt::format("{}{}: {}", found.empty() ? "" : ", ", actuator,
                         !writer                   ? "nobody"
                         : *writer == Writer::Hand ? "teleop"
                                                   : program);
  return ok("Setpoints", found);
}

std::string silentDevice(const PreflightInputs& in, const PreflightLimits& limits) {
  const auto objection = [&](const char* device, const std::optional<double>& age_s) {
    if (!age_s) return fmt::format("no state of the {} yet", device);
    if (*age_s <= limits.device_age_s) return std::string();
    return fmt::format("no state of the {} for {:.1f} s", device, *age_s);
  };
  std::string out = objection("base", in.base_age_s);
  if (out.empty()) out = objection("arm", in.arm_age_s);
  if (out.empty() && in.has_pumps) out = objection("pumps", in.pumps_age_s);
  return out;
}

bool allOk(const std::vector<Check>& checks) {
  return std::all_of(checks.begin(), checks.end(), [](const Check& check) { return check.ok; });
}

std::string firstFailure(const std::vector<Check>& checks) {
  for (const Check& check : checks) {
    if (check.ok) continue;
    return check.name + ": " + check.detail + (check.action.empty() ? "" : "; " + check.action);
  }
  return {};
}

}  // namespace kiln
