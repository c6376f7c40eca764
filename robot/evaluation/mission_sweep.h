#pragma once

#include <string>
#include <vector>

#include "robot/evaluation/evaluation.h"
#include "robot/evaluation/mission_run.h"

namespace kiln {

struct SeedResult {
  int seed = 0;
  Result<MissionRun> run = MissionRun{};
};

/// The robot of the run goes through its calibration yard first, or takes what was found there before
/// (yard_calibration.h).
[[nodiscard]] Result<void> addCalibration(MissionRunOptions& run);

/// Runs a mission (empty: the first of the catalogue) on all seeds in lockstep, with the truth
/// trace, `options.jobs` at a time; results in seed order whatever the timing. With
/// `options.calibrate` each seed's robot is calibrated first.
/// @param robot_args  passed on to kiln-robotd.
[[nodiscard]] std::vector<SeedResult> runSeeds(const SweepOptions& options,
                                               const std::string& mission = "",
                                               const std::vector<std::string>& robot_args = {});

}  // namespace kiln
