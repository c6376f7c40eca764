#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/core/error.h"
#include "robot/evaluation/base_trace.h"
#include "robot/evaluation/mission_run.h"
#include "robot/localization/mapping/map_builder.h"

namespace kiln {

/// A recorded mapping drive.
struct MappingDrive {
  MissionRun run;         ///< with the truth's trace
  std::string recording;  ///< .mcap
};

/// Drives mission `mapping` of one seed in the full world, lockstep, and records it into `folder`
/// (an empty one). Error: the drive did not get back to its start, or touched something.
[[nodiscard]] Result<MappingDrive> driveForMap(int seed, const std::string& folder,
                                               const std::string& programs = {});

/// Where the keyframes of a map lie against where the robot truly was.
struct KeyframeErrors {
  std::vector<double> position_m, yaw_deg;
  std::vector<double> return_m;  ///< of the last ones, within 1 m of the first
};
[[nodiscard]] KeyframeErrors keyframeErrors(const BuiltMap& built, const BaseTrace& truth);

/// Wheel odometry alone against the truth where the drive ended, laid over the true start; nullopt
/// without a track.
[[nodiscard]] std::optional<double> odometryErrorAtReturn(const MissionRun& run);

}  // namespace kiln
