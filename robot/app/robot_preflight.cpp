// What the preflight checks look at.
#include <cmath>

#include "common/record/record_file.h"
#include "robot/app/frame_tree.h"
#include "robot/app/robot_reporting.h"

namespace kiln {
namespace {

constexpr Duration kDiskPeriod = std::chrono::seconds(2);
constexpr double kFresh_s = 0.5;  ///< an edge that has not moved for so long is not there

template <class T>
std::optional<Stamp> stampOf(const std::optional<T>& state) {
  return state ? std::optional(state->stamp) : std::nullopt;
}

/// The value while it is fresh.
template <class T>
std::optional<T> fresh(const std::optional<T>& state, Stamp now) {
  const auto age_s = ageOf(stampOf(state), now);
  return age_s && *age_s < kFresh_s ? state : std::nullopt;
}

}  // namespace

void RobotReporting::runChecks(Stamp now) {
  checkDisk(now);
  const PreflightInputs found = preflightInputs(now);
  checks_ = preflight(found, body_.settings.preflight);
  for (Check& check : parts_.mission.mission().checks(now)) checks_.push_back(std::move(check));
  std::vector<ActuatorWriter> writers{{"base", body_.base.tracking().writer},
                                      {"arm", body_.arm.tracking().writer}};
  if (found.has_pumps) writers.push_back({"pumps", body_.pumps.tracking().writer});
  checks_.push_back(writersCheck(writers, parts_.mission.host().mode()));
  silent_device_ = silentDevice(found, body_.settings.preflight);
  silent_lidar_ = silentLidar(found, body_.settings.preflight);
  late_product_ = lateProduct(found, body_.settings.preflight);
}

std::vector<std::string> RobotReporting::missingTransforms(Stamp now) const {
  const auto base_state = fresh(body_.devices.base.state(), now);
  FrameSources sources{now, body_.robot, joints(fresh(body_.devices.arm.state(), now)),
                       std::nullopt, parts_.localization.tracked().X_map_base_3d};
  if (base_state) sources.X_odom_base = body_.base.tracking().X_odom_base;
  return missingEdges(frameTree(sources));
}

/// Stamps of devices may lie in the past, by what their way takes (their rows look at the age), but
/// never in the future. A station stamps its commands by its idea of our clock; only that of the
/// lease's holder matters.
std::vector<ClockReading> RobotReporting::clockReadings(Stamp now) const {
  std::vector<ClockReading> clocks;
  const auto device = [&](const char* name, std::optional<Stamp> stamp) {
    if (stamp) clocks.push_back({name, std::min(0.0, toSeconds(now - *stamp))});
  };
  device("the arm", stampOf(body_.devices.arm.state()));
  device("the base", stampOf(body_.devices.base.state()));
  device("the pump board", stampOf(body_.pump_device.state()));
  device("the LiDAR", parts_.intake.perception().lastScan());
  if (!parts_.link || body_.options.lockstep || body_.options.environment == Environment::Replay)
    return clocks;
  const std::string holder = parts_.desk.authority().lease(now).holder_client;
  for (const OperatorPeer& peer : parts_.link->operators()) {
    if (peer.client_id == holder) clocks.push_back({peer.name + "'s station", peer.clock_error_s});
  }
  return clocks;
}

void RobotReporting::checkDisk(Stamp now) {
  if (disk_seen_ && now - *disk_seen_ < kDiskPeriod) return;
  disk_seen_ = now;
  const auto free = freeDiskBytes(body_.options.state_dir.empty() ? "." : body_.options.state_dir);
  disk_free_gb_ = free ? std::optional(1e-9 * static_cast<double>(*free)) : std::nullopt;
}

PreflightInputs RobotReporting::preflightInputs(Stamp now) const {
  PreflightInputs in;
  const auto arm_state = body_.devices.arm.state();
  const auto base_state = body_.devices.base.state();
  in.devices_connected = body_.devices.connected();
  in.arm_age_s = ageOf(stampOf(arm_state), now);
  in.base_age_s = ageOf(stampOf(base_state), now);
  in.lacking = parts_.mission.lacking();
  in.has_pumps = body_.devices.pumps != nullptr;
  in.pumps = body_.pump_device.state();
  in.pumps_age_s = ageOf(stampOf(in.pumps), now);
  in.lidar_age_s = ageOf(parts_.intake.perception().lastScan(), now);
  if (body_.devices.lidar != nullptr) in.lidar_defects = body_.devices.lidar->defects();
  in.cloud_age_s = ageOf(parts_.intake.perception().lastCloud(), now);
  if (arm_state) in.arm_safety = arm_state->safety;
  if (base_state) in.battery_v = base_state->battery_v;
  in.pose_health = parts_.localization.tracked().health;
  if (body_.fence) in.fence_room_m = body_.fence->room(parts_.localization.pose());
  in.storage_ok = !parts_.mission.host().storageProblem();
  in.missing_edges = missingTransforms(now);
  in.tree_edges = fullTreeSize();
  in.clocks = clockReadings(now);
  in.limits = limits_;
  in.reported_beyond_limit =
      reportedBeyondLimits(body_.settings, body_.robot, arm_state, base_state);
  in.map_in_use = body_.settings.localization.method != "odometry";
  in.map_fit = parts_.localization.mapFit();
  in.match_failure = parts_.localization.matchFailure();
  in.disk_free_gb = disk_free_gb_;
  in.recording_needs_gb = body_.settings.recording.min_free_gb;
  return in;
}

}  // namespace kiln
