// What the preflight checks look at.
#include <cmath>

#include "common/record/record_file.h"
#include "robot/app/frame_tree.h"
#include "robot/app/robot_impl.h"

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

std::vector<std::string> Robot::Impl::missingTransforms(Stamp now) const {
  const auto base_state = fresh(devices.base.state(), now);
  FrameSources sources{now, robot, joints(fresh(devices.arm.state(), now)), std::nullopt,
                       tracked.X_map_base_3d};
  if (base_state) sources.X_odom_base = base.tracking().X_odom_base;
  return missingEdges(frameTree(sources));
}

/// Stamps of devices may lie in the past, by what their way takes (their rows look at the age), but
/// never in the future. A station stamps its commands by its idea of our clock; only that of the
/// lease's holder matters.
std::vector<ClockReading> Robot::Impl::clockReadings(Stamp now) const {
  std::vector<ClockReading> clocks;
  const auto device = [&](const char* name, std::optional<Stamp> stamp) {
    if (stamp) clocks.push_back({name, std::min(0.0, toSeconds(now - *stamp))});
  };
  device("the arm", stampOf(devices.arm.state()));
  device("the base", stampOf(devices.base.state()));
  device("the pump board", stampOf(devices.pumps.state()));
  device("the LiDAR", perception.lastScan());
  if (!link || options.lockstep || options.environment == Environment::Replay) return clocks;
  const std::string holder = authority.lease(now).holder_client;
  for (const OperatorPeer& peer : link->operators()) {
    if (peer.client_id == holder) clocks.push_back({peer.name + "'s station", peer.clock_error_s});
  }
  return clocks;
}

void Robot::Impl::lookAtDisk(Stamp now) {
  if (disk_seen && now - *disk_seen < kDiskPeriod) return;
  disk_seen = now;
  const auto free = freeDiskBytes(options.state_dir.empty() ? "." : options.state_dir);
  disk_free_gb = free ? std::optional(1e-9 * static_cast<double>(*free)) : std::nullopt;
}

void Robot::Impl::noteMatch(const Result<ScanMatch>& match, bool believed) {
  if (!match) {
    match_failure = match.error().message;
  } else if (!believed) {
    match_failure = "the map fits elsewhere";
  } else {
    map_fit = MapFit{match->inlier_fraction, match->rms_m};
    match_failure.clear();
  }
}

void Robot::Impl::forgetMatch() {
  map_fit.reset();
  match_failure.clear();
}

PreflightInputs Robot::Impl::preflightInputs(Stamp now) const {
  PreflightInputs in;
  const auto arm_state = devices.arm.state();
  const auto base_state = devices.base.state();
  in.devices_connected = devices.connected();
  in.arm_age_s = ageOf(stampOf(arm_state), now);
  in.base_age_s = ageOf(stampOf(base_state), now);
  in.pumps = devices.pumps.state();
  in.pumps_age_s = ageOf(stampOf(in.pumps), now);
  in.lidar_age_s = ageOf(perception.lastScan(), now);
  if (devices.lidar != nullptr) in.lidar_defects = devices.lidar->defects();
  in.cloud_age_s = ageOf(perception.lastCloud(), now);
  if (arm_state) in.arm_safety = arm_state->safety;
  if (base_state) in.battery_v = base_state->battery_v;
  in.pose_health = tracked.health;
  if (fence) in.fence_room_m = fence->room(pose());
  in.storage_ok = !host->storageProblem();
  in.missing_edges = missingTransforms(now);
  in.tree_edges = fullTreeSize();
  in.clocks = clockReadings(now);
  in.limits = limits;
  in.reported_beyond_limit = reportedBeyondLimits(settings, robot, arm_state, base_state);
  in.map_in_use = settings.localization.method != "odometry";
  in.map_fit = map_fit;
  in.match_failure = match_failure;
  in.disk_free_gb = disk_free_gb;
  in.recording_needs_gb = settings.recording.min_free_gb;
  return in;
}

}  // namespace kiln
