#include <algorithm>
#include <map>

#include <nlohmann/json.hpp>

#include "robot/evaluation/evaluation.h"
#include "robot/evaluation/mission_sweep.h"

// The paper's lab test (section "Evaluation", Challenge 2): a run counts when all bricks stand where
// the blueprint has them, by the simulator's referee, and nothing fell or was hit.
namespace kiln {
namespace {

using nlohmann::json;

/// Seconds of a run by what was done, as the paper's table has it.
const std::map<std::string, std::string> kComponents{
    {"DriveToPile", "drive"},     {"DriveToStack", "drive"},  {"ApproachStack", "drive"},
    {"DriveToMarker", "drive"},   {"DriveToWall", "drive"},   {"FindPile", "perceive"},
    {"LocateBricks", "perceive"}, {"FindMarker", "perceive"}, {"LocateWall", "perceive"},
    {"TakeBrick", "pick"},        {"StoreBrick", "store"},    {"TakeOutBrick", "unload"},
    {"SetBrick", "place"}};

}  // namespace

Result<EvaluationResult> evaluateLabWall(const SweepOptions& options) {
  json runs = json::array();
  std::map<std::string, std::vector<double>> parts;
  std::vector<double> mission_s, placed, points, real_time_factor;
  double successes = 0, collisions = 0, falls = 0;
  std::string notes;
  for (const SeedResult& result : runSeeds(options, "wall")) {
    if (!result.run) {
      runs.push_back(
          {{"seed", result.seed}, {"outcome", "error"}, {"reason", result.run.error().message}});
      notes += fmt::format("seed {}: {}\n", result.seed, result.run.error().message);
      continue;
    }
    json report = json::parse(result.run->report_json);
    collisions += static_cast<double>(report.at("collisions").size());
    falls += report.value("falls", 0.0);
    placed.push_back(report.value("placed", 0.0));
    points.push_back(report.value("points", 0.0));
    real_time_factor.push_back(result.run->realTimeFactor());
    if (result.run->success) {
      ++successes;
      mission_s.push_back(report.at("mission_s"));
      std::map<std::string, double> spent;
      for (const json& state : report.at("states"))
        if (const auto part = kComponents.find(state.at("name")); part != kComponents.end())
          spent[part->second] += state.at("leave").get<double>() - state.at("enter").get<double>();
      for (const auto& [name, s] : spent) parts[name].push_back(s);
      report["component_s"] = spent;
    } else {
      notes += fmt::format("seed {}: {} placed; {}: {}\n", result.seed, placed.back(),
                           report.at("outcome").get<std::string>(),
                           report.at("reason").get<std::string>());
    }
    report.erase("states");
    runs.push_back(std::move(report));
  }
  EvaluationResult out;
  out.name = "lab-wall";
  out.figures = {{"success", successes, "", "", true},
                 {"runs", static_cast<double>(runs.size()), "", "", true},
                 {"median_s", median(mission_s), "s", "", true},
                 {"placed_median", median(placed), "", "", true},
                 {"points_median", median(points), "", "", true},
                 {"collisions_total", collisions, "", "", true},
                 {"falls_total", falls, "", "", true},
                 {"real_time_factor", median(real_time_factor), "", "", true}};
  for (const auto& [name, s] : parts)
    out.figures.push_back({name + "_median_s", median(s), "s", "", true});
  out.runs_json = runs.dump();
  out.notes = std::move(notes);
  return out;
}

}  // namespace kiln
