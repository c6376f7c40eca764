#pragma once

#include <string>
#include <vector>

#include "robot/evaluation/mission_run.h"

namespace kiln {

/// Errors of the fused heat-source position against the world's truth, in the true thermal camera's
/// frame at the time of each estimate; only where the plate is at most 1.0 m away and at most 10
/// degrees off the axis.
struct HeatErrors {
  std::vector<double> range_m;           ///< |estimated - true| distance
  std::vector<double> lateral_m;         ///< perpendicular to the true viewing ray
  std::vector<double> baseline_range_m;  ///< the paper's bounding-box method on the same frames
};
/// @param run  made with MissionRunOptions::trace.
void appendHeatErrors(const MissionRun& run, HeatErrors& errors);

}  // namespace kiln
