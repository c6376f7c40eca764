#pragma once

#include <string>
#include <vector>

#include "robot/evaluation/figures.h"

namespace kiln {

/// What every sweep takes from the command line.
struct SweepOptions {
  int first_seed = 1;
  int last_seed = 20;
  int jobs = 1;              ///< runs side by side; 1 for an honest real_time_factor
  std::string out;           ///< where a calibration writes its result
  std::string world;         ///< world file; empty = the evaluation's own
  std::string localization;  ///< method for kiln-robotd; empty = its config's
  bool calibrate = true;     ///< missions of a sweep: each seed's robot is calibrated first
};

/// One named evaluation of scenario.md section 7 or a calibration.
struct Evaluation {
  std::string name;
  std::string doc;
  Result<EvaluationResult> (*run)(const SweepOptions&);
  SweepOptions defaults;
};
[[nodiscard]] const std::vector<Evaluation>& evaluations();

[[nodiscard]] Result<EvaluationResult> evaluateFire(const SweepOptions& options);
[[nodiscard]] Result<EvaluationResult> evaluateLocalization(const SweepOptions& options);
[[nodiscard]] Result<EvaluationResult> evaluateRelocalization(const SweepOptions& options);
[[nodiscard]] Result<EvaluationResult> evaluateFallback(const SweepOptions& options);
[[nodiscard]] Result<EvaluationResult> evaluateStop(const SweepOptions& options);
[[nodiscard]] Result<EvaluationResult> evaluateMapping(const SweepOptions& options);
[[nodiscard]] Result<EvaluationResult> evaluatePlaceCheck(const SweepOptions& options);
[[nodiscard]] Result<EvaluationResult> evaluateResume(const SweepOptions& options);
[[nodiscard]] Result<EvaluationResult> calibrateSensors(const SweepOptions& options);
[[nodiscard]] Result<EvaluationResult> calibrateSpray(const SweepOptions& options);

}  // namespace kiln
