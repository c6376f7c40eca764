#include "robot/evaluation/figures.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <thread>

#include <nlohmann/json.hpp>
#include <sys/utsname.h>

#include "common/config/config_archive.h"
#include "common/core/atomic_file.h"

namespace kiln {
namespace {

struct GoalConfig {
  std::string evaluation, id, relation = "<=", kept_from;
  double limit = 0.0;
  void visit(ConfigArchive& a) {
    a.field("evaluation", evaluation, "name of the evaluation");
    a.field("id", id, "fixed id of the figure");
    a.field("relation", relation, "<= or >=");
    a.field("limit", limit, "", -1e9, 1e9, "the goal");
    a.field("kept_from", kept_from, "whose figure it is measured against");
  }
};
struct GoalsConfig {
  std::vector<GoalConfig> goals;
  void visit(ConfigArchive& a) { a.list("goals", goals, "goals of the evaluations"); }
};

std::string machineName() {
  utsname name{};
  uname(&name);
  return fmt::format("{} {}, {} cores", name.sysname, name.machine,
                     std::thread::hardware_concurrency());
}

}  // namespace

Result<std::vector<Goal>> loadGoals(const std::string& path) {
  GoalsConfig config;
  if (auto loaded = loadConfig(path, config); !loaded) return tl::make_unexpected(loaded.error());
  std::vector<Goal> goals;
  for (const GoalConfig& goal : config.goals) {
    if (goal.relation != "<=" && goal.relation != ">=") {
      return makeError(ErrorCode::InvalidInput,
                       "{}: goal '{}': relation '{}' must be <= or >=", path, goal.id,
                       goal.relation);
    }
    goals.push_back({goal.evaluation, goal.id, goal.relation, goal.limit, goal.kept_from});
  }
  return goals;
}

void judge(Metric& figure, const std::string& evaluation, const std::vector<Goal>& goals) {
  for (const Goal& goal : goals) {
    if (goal.evaluation != evaluation || goal.id != figure.id) continue;
    figure.goal = fmt::format("{} {}", goal.relation, goal.limit);
    figure.ok = goal.relation == "<=" ? figure.value <= goal.limit
                                      : figure.value >= goal.limit;  // NaN misses both
  }
}

double quantile(std::vector<double> values, double q) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  std::sort(values.begin(), values.end());
  const double position = q * static_cast<double>(values.size() - 1);
  const auto low = static_cast<std::size_t>(position);
  const std::size_t high = std::min(low + 1, values.size() - 1);
  return values[low] + (position - static_cast<double>(low)) * (values[high] - values[low]);
}

std::string formatTable(const EvaluationResult& result) {
  std::string out = fmt::format("{}\n{:<28} {:>12} {:<8} {:>12}  {}\n", result.name, "figure",
                                "value", "unit", "goal", "");
  for (const Metric& figure : result.figures) {
    out += fmt::format("{:<28} {:>12.4g} {:<8} {:>12}  {}\n", figure.id, figure.value, figure.unit,
                       figure.goal.empty() ? "-" : figure.goal,
                       figure.goal.empty() ? ""
                       : figure.ok         ? "ok"
                                           : "MISSED");
  }
  if (!result.notes.empty()) out += result.notes + "\n";
  return out;
}

Result<void> writeJson(const EvaluationResult& result, const std::string& path) {
  nlohmann::json json{{"name", result.name}, {"version", KILN_VERSION}, {"machine", machineName()}};
  json["figures"] = nlohmann::json::array();
  for (const Metric& figure : result.figures) {
    json["figures"].push_back(
        {{"id", figure.id},
         {"value", std::isfinite(figure.value) ? nlohmann::json(figure.value) : nlohmann::json()},
         {"unit", figure.unit},
         {"goal", figure.goal},
         {"ok", figure.ok}});
  }
  json["runs"] = nlohmann::json::parse(result.runs_json);
  return writeFileAtomically(path, json.dump(2) + "\n");
}

}  // namespace kiln
