#include "robot/evaluation/figures.h"

#include <cmath>
#include <fstream>
#include <limits>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/support/paths.h"

namespace kiln {
namespace {

TEST(Figures, QuantileInterpolatesBetweenOrderedValues) {
  EXPECT_DOUBLE_EQ(median({3, 1, 2}), 2.0);
  EXPECT_DOUBLE_EQ(median({4, 1, 2, 3}), 2.5);
  EXPECT_DOUBLE_EQ(quantile({0, 10}, 0.95), 9.5);
  EXPECT_TRUE(std::isnan(median({})));
}

TEST(Figures, JudgesAgainstTheGoalOfItsEvaluationOnly) {
  const std::vector<Goal> goals = {{"fire", "rate", ">=", 0.95, ""},
                                   {"fire", "time", "<=", 330, ""}};
  Metric rate{"rate", 0.9, "", "", true};
  judge(rate, "fire", goals);
  EXPECT_FALSE(rate.ok);
  EXPECT_EQ(rate.goal, ">= 0.95");
  Metric elsewhere{"rate", 0.9, "", "", true};
  judge(elsewhere, "wall", goals);
  EXPECT_TRUE(elsewhere.ok);
}

TEST(Figures, AFigureThatWasNotMeasuredMissesItsGoal) {
  const std::vector<Goal> goals = {{"fire", "time", "<=", 330, ""}};
  Metric unknown{"time", std::numeric_limits<double>::quiet_NaN(), "s", "", true};
  judge(unknown, "fire", goals);
  EXPECT_FALSE(unknown.ok);
}

TEST(Figures, GoalsFileHoldsTheFixedIds) {
  const auto goals = loadGoals(kiln::sourceDir() + "/tests/bench/goals.yaml");
  ASSERT_TRUE(goals.has_value()) << goals.error();
  EXPECT_EQ(goals->front().evaluation, "fire");
  EXPECT_EQ(goals->front().id, "success_rate");
  EXPECT_DOUBLE_EQ(goals->front().limit, 0.98);
}

TEST(Figures, JsonHasTheContractsKeys) {
  EvaluationResult result;
  result.name = "fire";
  result.figures = {{"a", 1.0, "m", "<= 2", true},
                    {"b", std::numeric_limits<double>::quiet_NaN(), "", "", false}};
  const std::string path = testing::TempDir() + "kiln-figures.json";
  ASSERT_TRUE(writeJson(result, path).has_value());
  std::ifstream in(path);
  const auto json = nlohmann::json::parse(in);
  for (const char* key : {"name", "version", "machine", "figures", "runs"})
    EXPECT_TRUE(json.contains(key)) << key;
  EXPECT_EQ(json["figures"][0]["goal"], "<= 2");
  EXPECT_TRUE(json["figures"][1]["value"].is_null()) << "NaN is not JSON";
}

TEST(Figures, RefusesToWriteOnAFullDisk) {
  EvaluationResult result;
  result.name = "fire";
  const auto written = writeJson(result, "/proc/kiln.json");
  ASSERT_FALSE(written.has_value());
  EXPECT_EQ(written.error().code, ErrorCode::Storage);
}

}  // namespace
}  // namespace kiln
