#pragma once

#include <map>
#include <string>
#include <variant>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "robot/evaluation/figures.h"

namespace kiln {

/// What an evaluation was asked for on the command line.
struct SweepOptions {
  int first_seed = 1;
  int last_seed = 20;
  int jobs = 1;                ///< runs side by side; 1 for an honest real_time_factor
  std::string out{};           ///< where a calibration writes its result
  std::string world{};         ///< world file; empty = the evaluation's own
  std::string localization{};  ///< method for kiln-robotd; empty = its config's
  bool calibrate = true;       ///< missions of a sweep: each seed's robot is calibrated first
  std::map<std::string, std::string> own{};  ///< options of one evaluation alone, without dashes
};

/// An option of an evaluation beside --seeds, --jobs and --json.
struct EvaluationOption {
  std::string flags;  ///< "--out"; a switch with its opposite: "--calibrate,!--no-calibrate"
  std::string doc;
  /// Where its value goes; none: SweepOptions::own.
  std::variant<std::monostate, std::string SweepOptions::*, bool SweepOptions::*> field;
};

/// How a run of one mission is judged beyond what holds for all: ended as finished, no collision.
struct MissionRule {
  std::string mission;  ///< empty: no rule
  /// Adds the mission's own keys to the merged report.
  /// @param robot, truth  the reports of kiln-robotd and kiln-sim.
  /// @return what was missed though the mission believes in its success; empty: nothing.
  std::string (*judge)(const nlohmann::json& robot, const nlohmann::json& truth,
                       nlohmann::json& report) = nullptr;
};

/// One named evaluation of scenario.md section 7, or a calibration, with all that kiln-eval must
/// know of it. To add one: its function, and an entry in evaluation.cpp.
struct Evaluation {
  std::string name;
  std::string doc;
  Result<EvaluationResult> (*run)(const SweepOptions&);
  SweepOptions defaults;
  std::vector<EvaluationOption> options{};
  MissionRule rule{};
  std::string goals = "tests/bench/goals.yaml";  ///< below the source tree
};
/// The evaluations that this program has (evaluation.cpp).
[[nodiscard]] const std::vector<Evaluation>& evaluations();
/// The rule that an evaluation brings for a mission; nullptr: none does.
[[nodiscard]] const MissionRule* missionRule(const std::string& mission);

[[nodiscard]] std::string judgeFire(const nlohmann::json& robot, const nlohmann::json& truth,
                                    nlohmann::json& report);
[[nodiscard]] Result<EvaluationResult> evaluateFire(const SweepOptions& options);
[[nodiscard]] Result<EvaluationResult> evaluateLocalization(const SweepOptions& options);
[[nodiscard]] Result<EvaluationResult> evaluateRelocalization(const SweepOptions& options);
[[nodiscard]] Result<EvaluationResult> evaluateFallback(const SweepOptions& options);
[[nodiscard]] Result<EvaluationResult> evaluateStop(const SweepOptions& options);
[[nodiscard]] Result<EvaluationResult> evaluateMarker(const SweepOptions& options);
[[nodiscard]] Result<EvaluationResult> evaluateMapping(const SweepOptions& options);
[[nodiscard]] Result<EvaluationResult> evaluatePlaceCheck(const SweepOptions& options);
[[nodiscard]] Result<EvaluationResult> evaluateResume(const SweepOptions& options);
[[nodiscard]] Result<EvaluationResult> evaluateBuildOrder(const SweepOptions& options);
[[nodiscard]] Result<EvaluationResult> evaluateBricks(const SweepOptions& options);
[[nodiscard]] std::string judgeWall(const nlohmann::json& robot, const nlohmann::json& truth,
                                    nlohmann::json& report);
[[nodiscard]] Result<EvaluationResult> evaluateWallSurvey(const SweepOptions& options);
[[nodiscard]] Result<EvaluationResult> evaluateLabWall(const SweepOptions& options);
[[nodiscard]] Result<EvaluationResult> calibrateSensors(const SweepOptions& options);
[[nodiscard]] Result<EvaluationResult> calibrateSpray(const SweepOptions& options);

}  // namespace kiln
