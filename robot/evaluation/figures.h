#pragma once

#include <string>
#include <vector>

#include "common/core/error.h"

namespace kiln {

/// One measured figure of an evaluation, held against its goal in tests/bench/goals.yaml.
struct Metric {
  std::string id;
  double value = 0.0;
  std::string unit;
  std::string goal;  ///< as text: "<= 330", empty if none is set
  bool ok = true;    ///< false = missed
};

/// A goal: `value <relation> limit`.
struct Goal {
  std::string evaluation, id, relation;
  double limit = 0.0;
  std::string kept_from;  ///< whose figure it is measured against
};

[[nodiscard]] Result<std::vector<Goal>> loadGoals(const std::string& path);
/// Fills goal and ok of a figure from the list; no goal = ok.
void judge(Metric& figure, const std::string& evaluation, const std::vector<Goal>& goals);

/// Order statistics; NaN for an empty list.
[[nodiscard]] double quantile(std::vector<double> values, double q);
[[nodiscard]] inline double median(std::vector<double> values) {
  return quantile(std::move(values), 0.5);
}

/// An evaluation's outcome: printed as a table, written as JSON.
struct EvaluationResult {
  std::string name;
  std::string goal_set;  ///< whose goals it is held against; empty = those of `name`
  std::vector<Metric> figures;
  std::string runs_json = "[]";  ///< a JSON list, one object a run
  std::string notes;
};
[[nodiscard]] std::string formatTable(const EvaluationResult& result);
[[nodiscard]] Result<void> writeJson(const EvaluationResult& result, const std::string& path);

}  // namespace kiln
