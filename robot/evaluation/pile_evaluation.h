#pragma once

#include <nlohmann/json_fwd.hpp>

#include "robot/evaluation/evaluation.h"

namespace kiln {

/// One seed of a world with a pile: from the start on the robot looks for the pile with its own
/// sensors, drives before it, sweeps and perceives its bricks; then held against the truth.
struct PileRun {
  std::string refused;                      ///< why nothing was perceived; empty: it was
  std::vector<double> position_m, yaw_deg;  ///< errors of the bricks trusted above 0.7
  int seen = 0;                     ///< bricks of which the model says that enough is in sight
  int trusted = 0;                  ///< of these above 0.7
  int wrong = 0;                    ///< above 0.7 and off by more than 5 cm
  int uncovered = 0;                ///< bricks that the plan did not hope to see well enough
  std::vector<double> cells_ratio;  ///< found of expected, a brick
  std::vector<double> gather_s, line_gap_deg;     ///< a sweep
  double found_off_m = 0.0, found_off_deg = 0.0;  ///< of the pile, at the first look
  double rough_off_m = 0.0, rough_off_deg = 0.0;  ///< and as a whole, after the sweeps
  double plan_s = 0.0;                            ///< processor time of the choice of views
  std::vector<std::string> sweeps;                ///< in words
  int collisions = 0;
};

/// @param calibrated  with the LiDAR's mounting and ranges as `kiln-eval calibrate` finds them for
///                    the same seed's head; else nominal.
/// @param needed_cells  of a brick, for the choice of views; 0: what perception needs.
[[nodiscard]] Result<PileRun> runPile(const std::string& world, int seed, bool calibrated,
                                      double needed_cells = 0.0);
[[nodiscard]] nlohmann::json toJson(const PileRun& run, int seed);

/// kiln-eval bricks --world WORLD.
[[nodiscard]] Result<EvaluationResult> evaluatePiles(const SweepOptions& options);

}  // namespace kiln
