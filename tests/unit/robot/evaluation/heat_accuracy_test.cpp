#include "robot/evaluation/heat_accuracy.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace kiln {
namespace {

using nlohmann::json;

/// The camera rests in the map's origin and looks along its Z; plates 0.8 m ahead and 3 m aside.
MissionRun runWith(const std::vector<std::array<double, 3>>& estimates) {
  json robot{
      {"truth",
       {{"fire_places", {{{"plate_xyz_m", {0.0, 0.0, 0.8}}}, {{"plate_xyz_m", {3.0, 0.0, 0.8}}}}}}},
      {"robot", {{"heat_estimates", json::array()}}}};
  for (const auto& p : estimates)
    robot["robot"]["heat_estimates"].push_back(
        {{"t", 1.0}, {"p_thermal", p}, {"baseline_range_m", 0.9}});
  MissionRun run;
  run.robot_json = robot.dump();
  for (const double t : {0.0, 2.0}) {
    const json thermal{{"xyz_m", {0, 0, 0}}, {"wxyz", {1, 0, 0, 0}}};
    run.trace_jsonl += json{{"t", t}, {"thermal", thermal}}.dump() + "\n";
  }
  return run;
}

TEST(HeatAccuracy, MeasuresAnEstimateAgainstTheNearestPlace) {
  HeatErrors errors;
  appendHeatErrors(runWith({{0.0, 0.0, 0.81}}), errors);
  ASSERT_EQ(errors.range_m.size(), 1U);
  EXPECT_NEAR(errors.range_m[0], 0.01, 1e-9);
  EXPECT_NEAR(errors.lateral_m[0], 0.0, 1e-9);
  EXPECT_NEAR(errors.baseline_range_m[0], 0.1, 1e-9);
  EXPECT_EQ(errors.gross, 0);
}

TEST(HeatAccuracy, CountsWhatIsFarFromEveryPlaceAsGross) {
  HeatErrors errors;
  // 0.6 m behind the near plate; 0.6 m above the far one, which is beyond 1 m and off the axis.
  appendHeatErrors(runWith({{0.0, 0.0, 1.4}, {3.0, 0.6, 0.8}}), errors);
  EXPECT_EQ(errors.gross, 2);
  EXPECT_TRUE(errors.range_m.empty());
}

TEST(HeatAccuracy, AnEstimateOfAFarPlaceIsNeitherGrossNorMeasured) {
  HeatErrors errors;
  appendHeatErrors(runWith({{3.0, 0.1, 0.8}}), errors);
  EXPECT_EQ(errors.gross, 0);
  EXPECT_TRUE(errors.range_m.empty());
}

}  // namespace
}  // namespace kiln
