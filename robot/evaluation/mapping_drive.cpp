#include "robot/evaluation/mapping_drive.h"

#include <cmath>
#include <filesystem>

#include <nlohmann/json.hpp>

#include "common/core/units.h"
#include "robot/evaluation/pose_accuracy.h"

namespace kiln {
namespace {

constexpr double kReturned_m = 1.0;
constexpr double kLongest_s = 200.0;  // robot time; a round takes less than a minute

double apart(const Pose2& a, const Pose2& b) { return std::hypot(a.x_m - b.x_m, a.y_m - b.y_m); }

}  // namespace

Result<MappingDrive> driveForMap(int seed, const std::string& folder, const std::string& programs) {
  MissionRunOptions options;
  options.programs = programs;
  options.mission = "mapping";
  options.seed = seed;
  options.trace = true;
  options.robot_args = {"--record", folder, "--until-s", std::to_string(kLongest_s)};
  auto run = runMission(options);
  if (!run) return tl::make_unexpected(run.error());
  if (!run->success) {
    const auto report = nlohmann::json::parse(run->report_json);
    return makeError(ErrorCode::Degenerate, "seed {}: the mapping drive failed: {}; collisions: {}",
                     seed, report.value("reason", std::string()), report.at("collisions").dump());
  }
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() == ".mcap")
      return MappingDrive{std::move(*run), entry.path().string()};
  }
  return makeError(ErrorCode::NotFound, "seed {}: the mapping drive left no recording in {}", seed,
                   folder);
}

KeyframeErrors keyframeErrors(const BuiltMap& built, const BaseTrace& truth) {
  KeyframeErrors out;
  for (std::size_t i = 0; i < built.poses.size(); ++i) {
    const auto real = truth.at(toSeconds(built.stamps[i]));
    if (!real) continue;
    const Pose2 mapped = projectToGround(built.poses[i]);
    out.position_m.push_back(apart(mapped, *real));
    out.yaw_deg.push_back(std::abs(wrapAngle(mapped.yaw_rad - real->yaw_rad)) / kDeg);
    const bool again = apart(mapped, projectToGround(built.poses.front())) < kReturned_m;
    if (again && i > built.poses.size() / 2) out.return_m.push_back(out.position_m.back());
  }
  return out;
}

std::optional<double> odometryErrorAtReturn(const MissionRun& run) {
  const std::vector<PoseSample> track = poseSamples(run);
  if (track.empty()) return std::nullopt;
  const Pose2 X_map_odom = track.front().truth * inverse(track.front().odometry);
  return apart(X_map_odom * track.back().odometry, track.back().truth);
}

}  // namespace kiln
