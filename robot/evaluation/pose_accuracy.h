#pragma once

#include <vector>

#include "common/geom/pose.h"
#include "robot/evaluation/mission_run.h"

namespace kiln {

/// What the robot believed of its pose, and the truth, at one moment.
struct PoseSample {
  double t_s = 0.0;
  Pose2 truth, believed;
  Pose2 odometry;                          ///< wheels alone, in odom
  double position_m = 0.0, yaw_deg = 0.0;  ///< error of the belief
  bool located = false;                    ///< false: the robot says that it is lost
  int resets = 0;
};

/// Five a second, over the whole run. @pre run.trace_jsonl was asked for.
[[nodiscard]] std::vector<PoseSample> poseSamples(const MissionRun& run);

/// Believed against true pose of the base, five samples a second, from the first fix after each
/// reset on.
struct PoseErrors {
  std::vector<double> position_m, yaw_deg;
  std::vector<double> doorway_m, doorway_deg;  ///< within half a metre of the doorway
  std::vector<double> fire_m, fire_deg;        ///< at rest within half a metre of a work pose
  std::vector<double> odometry_m;              ///< wheel odometry alone, on the same way
  std::vector<double> odometry_doorway_m;
  int lost = 0;  ///< how often a pose that was known got lost
};

/// Nominal places that the figures are asked for, metres in map.
struct PosePlaces {
  double doorway_x_m = 0.0;
  std::vector<std::pair<double, double>> work_poses;
};

/// Adds one run. @pre run.trace_jsonl was asked for.
void appendPoseErrors(const MissionRun& run, const PosePlaces& places, PoseErrors& errors);

}  // namespace kiln
