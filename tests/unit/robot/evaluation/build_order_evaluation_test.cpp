#include <filesystem>
#include <map>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "robot/evaluation/evaluation.h"
#include "robot/scene/blueprint.h"

namespace kiln {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

std::map<std::string, double> valuesOf(const EvaluationResult& result) {
  std::map<std::string, double> values;
  for (const Metric& figure : result.figures) values[figure.id] = figure.value;
  return values;
}

TEST(BuildOrderEvaluation, GivesThePapersTableOfAFewWalls) {
  SweepOptions options;
  options.first_seed = 1;
  options.last_seed = 4;
  const auto result = evaluateBuildOrder(options);
  ASSERT_TRUE(result.has_value()) << result.error();
  auto values = valuesOf(*result);
  EXPECT_EQ(values["optimal_proven"], 1.0);
  EXPECT_EQ(values["orders_refused"], 0.0);
  EXPECT_GT(values["positions_mean"], 2.0);
  EXPECT_LE(values["positions_mean"], values["greedy_positions_mean"]);
  EXPECT_GE(values["fastest_saves_mean_s"], 0.0);
  EXPECT_GE(values["runtime_max_ms"], values["runtime_mean_ms"]);
  EXPECT_THAT(result->notes,
              AllOf(HasSubstr("paper "), HasSubstr(" 0.90  |"), HasSubstr(" 1.50  |")));
}

TEST(BuildOrderEvaluation, TellsTheOrderOfOneBlueprint) {
  const auto path =
      std::filesystem::temp_directory_path() / ("kiln_wall_" + std::to_string(::getpid()) + ".txt");
  ASSERT_TRUE(saveBlueprint(randomBlueprint(5), path.string()).has_value());
  SweepOptions options;
  options.own["blueprint"] = path.string();
  const auto result = evaluateBuildOrder(options);
  std::filesystem::remove(path);
  ASSERT_TRUE(result.has_value()) << result.error();
  EXPECT_THAT(result->notes, AllOf(HasSubstr("1 blueprints"), HasSubstr("base at")));
  const auto absent = evaluateBuildOrder(options);
  ASSERT_FALSE(absent.has_value());
  EXPECT_THAT(absent.error().message, HasSubstr(path.string()));
}

}  // namespace
}  // namespace kiln
