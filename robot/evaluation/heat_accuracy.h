#pragma once

#include <string>
#include <vector>

#include "robot/evaluation/mission_run.h"

namespace kiln {

/// Errors of the fused heat-source position against the world's truth, in the true thermal camera's
/// frame at the time of each estimate. Each estimate belongs to the fire place that it is nearest
/// to. Off by more than 0.5 m it is gross, from wherever it was seen; the others are measured where
/// the plate is at most 1.0 m away and at most 10 degrees off the axis.
struct HeatErrors {
  std::vector<double> range_m;           ///< |estimated - true| distance
  std::vector<double> lateral_m;         ///< perpendicular to the true viewing ray
  std::vector<double> baseline_range_m;  ///< the paper's bounding-box method on the same frames
  int gross = 0;
};
/// @param run  made with MissionRunOptions::trace.
void appendHeatErrors(const MissionRun& run, HeatErrors& errors);

}  // namespace kiln
