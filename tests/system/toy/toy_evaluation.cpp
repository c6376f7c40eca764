// In place of robot/evaluation/evaluation.cpp: a kiln-eval that knows the toy's evaluation alone.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "robot/evaluation/evaluation.h"
#include "robot/evaluation/mission_run.h"

namespace kiln {
namespace {

using nlohmann::json;

std::string judgeToy(const json& robot, const json&, json& report) {
  report["toy_x_m"] = robot.at("toy_x_m");
  return robot.at("toy_x_m").get<double>() > 0.5 ? "" : "hardly moved";
}

/// Where each seed's robot stops against where it was told to.
Result<EvaluationResult> evaluateToy(const SweepOptions& options) {
  const auto given = [&](const char* name, const char* otherwise) {
    const auto found = options.own.find(name);
    return found == options.own.end() ? std::string(otherwise) : found->second;
  };
  const std::string distance = given("distance-m", "1.0");
  EvaluationResult out;
  out.name = "toy";
  double successes = 0.0, worst_m = 0.0;
  json runs = json::array();
  for (int seed = options.first_seed; seed <= options.last_seed; ++seed) {
    MissionRunOptions run;
    run.programs = given("programs", "");
    run.mission = "toy";
    run.seed = seed;
    run.robot_args = {"--set=toy.distance_m=" + distance};
    const auto ran = runMission(run);
    if (!ran) return tl::make_unexpected(ran.error());
    successes += ran->success ? 1.0 : 0.0;
    runs.push_back(json::parse(ran->report_json));
    worst_m =
        std::max(worst_m, std::abs(runs.back().at("toy_x_m").get<double>() - std::stod(distance)));
  }
  const double seeds = options.last_seed - options.first_seed + 1;
  out.figures = {{"success_rate", successes / seeds, "", "", true},
                 {"stop_error_max_m", worst_m, "m", "", true}};
  out.runs_json = runs.dump();
  return out;
}

}  // namespace

const std::vector<Evaluation>& evaluations() {
  static const std::vector<Evaluation> kAll{
      {"toy",
       "where the toy stops",
       evaluateToy,
       {1, 1},
       {{"--distance-m", "how far it is told to drive", {}},
        {"--programs", "folder of kiln-sim and kiln-robotd", {}}},
       {"toy", judgeToy},
       "tests/system/toy/goals.yaml"}};
  return kAll;
}

}  // namespace kiln
