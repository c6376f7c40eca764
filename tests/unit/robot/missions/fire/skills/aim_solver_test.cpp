#include "robot/missions/fire/skills/aim_solver.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "common/core/units.h"
#include "robot/missions/fire/skills/jet.h"

namespace kiln {
namespace {

AimTarget place(double facing_rad) {
  return {{12.1, 2.8, 1.0}, {std::cos(facing_rad), std::sin(facing_rad), 0.0}, 0.10};
}
Result<void> always(const Eigen::Isometry3d&) { return {}; }

TEST(AimSolver, EveryVariationPassesThroughTheMiddleOfTheOpening) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> facing(-M_PI, M_PI);
  std::uniform_real_distribution<double> flow(0.7, 1.0);
  SprayCalibration calibration;
  calibration.lateral_m = {0.002, 0.004, 0.006, 0.008, 0.01, 0.012};
  for (const AimVariation& variation : aimVariations({})) {
    const AimTarget target = place(facing(random));
    const double scale = flow(random);
    const Eigen::Isometry3d X = aimNozzle(target, variation, calibration, scale);
    const JetMiss miss = jetMiss(calibration, X, target.p_opening_map(), target.normal_map, scale);
    ASSERT_TRUE(miss.reaches);
    EXPECT_LT(miss.distance_m, 0.002) << variation.standoff_m << " " << variation.lateral_rad;
    EXPECT_NEAR(X.linear().determinant(), 1.0, 1e-9);
  }
}

TEST(AimSolver, ThePreferredPoseIsLevelInTheOpeningAndHitsThePlate) {
  const AimTarget target = place(M_PI);
  const auto solution = solveAim(target, {}, {}, 1.0, always);
  ASSERT_TRUE(solution.has_value());
  EXPECT_NEAR(solution->variation.standoff_m, 0.8, 1e-9);
  EXPECT_NEAR(solution->variation.lateral_rad, 0.0, 1e-9);
  const JetMiss opening =
      jetMiss({}, solution->X_map_nozzle, target.p_opening_map(), target.normal_map, 1.0);
  EXPECT_LT(opening.angle_rad, 0.03);
  const JetMiss plate =
      jetMiss({}, solution->X_map_nozzle, target.p_plate_map, target.normal_map, 1.0);
  EXPECT_LT(plate.distance_m, 0.01) << "10 cm behind the opening";
  // Nozzle 0.7 m before the opening, lower by the drop on that way.
  EXPECT_NEAR(solution->X_map_nozzle.translation().x(), 12.1 - 0.8, 1e-9);
  EXPECT_NEAR(solution->X_map_nozzle.translation().z(), 1.0 - 0.0668, 1e-3);
}

TEST(AimSolver, TakesTheNearestFeasibleVariation) {
  const auto only_far = [](const Eigen::Isometry3d& X) -> Result<void> {
    if (12.1 - X.translation().x() > 0.87) return {};
    return makeError(ErrorCode::Refused, "too near");
  };
  const auto solution = solveAim(place(M_PI), {}, {}, 1.0, only_far);
  ASSERT_TRUE(solution.has_value());
  EXPECT_NEAR(solution->variation.standoff_m, 0.9, 1e-9);
  EXPECT_EQ(solution->variation.lateral_rad, 0.0);
}

TEST(AimSolver, SaysWhyThePreferredPoseIsOutOfReach) {
  const auto never = [](const Eigen::Isometry3d&) -> Result<void> {
    return makeError(ErrorCode::Refused, "elbow would hit the tank");
  };
  const auto solution = solveAim(place(0.0), {}, {}, 1.0, never);
  ASSERT_FALSE(solution.has_value());
  EXPECT_NE(solution.error().message.find("elbow would hit the tank"), std::string::npos);
}

TEST(AimSolver, VariationsStayWithinTheirBounds) {
  const auto variations = aimVariations({});
  EXPECT_EQ(variations.size(), 7u * 5u * 2u) << "0.65 to 0.95 m, -20 to 20 deg, two heights";
  for (const AimVariation& v : variations) {
    EXPECT_GE(v.standoff_m, 0.65 - 1e-9);
    EXPECT_LE(v.standoff_m, 0.95 + 1e-9);
    EXPECT_LE(std::abs(v.lateral_rad), 20.0 * kDeg + 1e-9);
  }
}

}  // namespace
}  // namespace kiln
