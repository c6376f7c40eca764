#include "robot/perception/calibration/nozzle_calibration.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "common/core/units.h"
#include "common/geom/camera_model.h"
#include "common/geom/pose.h"

namespace kiln {
namespace {

const Eigen::Isometry3d kNozzle = makePose({0.06, 0.05, 0.20}, {90 * kDeg, -90 * kDeg, 0});
const Eigen::Isometry3d kThermal = makePose({-0.06, 0.04, 0.13}, {0, 0, 0});
const BoardPlane kBoard{{2.0, 0.1, 1.1}, {-1, 0, 0}, 0.005, 1000};

Eigen::Vector3d ballistic(const Eigen::Isometry3d& X_base_nozzle, double d, double flow) {
  const double t = d / (6.0 * flow);
  return X_base_nozzle * Eigen::Vector3d(d, 0, 0) - Eigen::Vector3d(0, 0, 0.5 * 9.81 * t * t);
}

struct Spray {
  double distance_spread_m = 0.25, roll_deg = 100.0, noise_px = 0.1;
  int count = 14;
};

/// What the camera sees of a jet of which everything is known.
std::vector<LandedJet> sprayed(const Eigen::Isometry3d& X_flange_nozzle, double flow,
                               const Spray& spray = {}) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  std::normal_distribution<double> noise(0.0, spray.noise_px);
  const CameraModel camera = CameraModel::fromHorizontalFov(160, 120, 57 * kDeg);
  std::vector<LandedJet> out;
  for (int i = 0; i < spray.count; ++i) {
    const double distance = 0.75 + spray.distance_spread_m * unit(random);
    const Eigen::Vector3d target =
        kBoard.p + Eigen::Vector3d(0, 0.3 * unit(random), 0.2 * unit(random));
    Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
    X.translation() = target + distance * Eigen::Vector3d(-1, 0.2 * unit(random), 0).normalized();
    X.linear() = frameFromXAndUp(target + Eigen::Vector3d(0, 0, 0.08) - X.translation(),
                                 Eigen::Vector3d::UnitZ());
    X.rotate(Eigen::AngleAxisd(spray.roll_deg * kDeg * unit(random), Eigen::Vector3d::UnitX()));
    const Eigen::Isometry3d X_base_flange = X * kNozzle.inverse(),
                            X_jet = X_base_flange * X_flange_nozzle;
    double a = 0.1, b = 2.0;  // the jet falls through the board once
    for (int k = 0; k < 60; ++k) {
      const double c = 0.5 * (a + b);
      (kBoard.normal.dot(ballistic(X_jet, c, flow) - kBoard.p) > 0.0 ? a : b) = c;
    }
    const auto px =
        camera.project((X_base_flange * kThermal).inverse() * ballistic(X_jet, a, flow));
    EXPECT_TRUE(px.has_value());
    out.push_back({X_base_flange, *px + Eigen::Vector2d(noise(random), noise(random)), 1.0});
  }
  return out;
}

Extrinsics thermalCamera() {
  Extrinsics out;
  out.X_parent_sensor = kThermal;
  out.sigma_m.setConstant(0.0005);
  out.sigma_rad.setConstant(0.03 * kDeg);
  return out;
}

Result<NozzleCalibration> calibrated(const std::vector<LandedJet>& landed) {
  return NozzleCalibrator({}).calibrate(landed, kNozzle, thermalCamera(), kBoard, ballistic);
}

TEST(NozzleCalibration, FindsTiltAndPlaceOfTheJetAndTheFlowBeside) {
  const Eigen::Isometry3d truth =
      kNozzle * makePose({0.0, -0.006, 0.005}, {0.0, 0.5 * kDeg, -0.4 * kDeg});
  const auto found = calibrated(sprayed(truth, 0.95));
  ASSERT_TRUE(found.has_value()) << found.error();
  const Eigen::Isometry3d off = truth.inverse() * found->flange_nozzle.X_parent_sensor;
  EXPECT_LT(off.linear().col(0).tail<2>().norm(), 0.12 * kDeg);
  EXPECT_LT(off.translation().tail<2>().norm(), 0.002);
  EXPECT_NEAR(found->flow, 0.95, 0.01);
  EXPECT_LT(found->flange_nozzle.rms_after, 0.15);
  EXPECT_GT(found->flange_nozzle.rms_before, 10.0 * found->flange_nozzle.rms_after);
  // The turn about the jet is not seen: its prior is all that is known.
  EXPECT_NEAR(found->flange_nozzle.sigma_rad.x(), NozzleCalibrator::Config{}.prior_deg * kDeg,
              1e-4);
  EXPECT_LT(found->flange_nozzle.sigma_rad.y(), 0.12 * kDeg);
}

TEST(NozzleCalibration, SaysWhatIsMissing) {
  const auto reason = [](const std::vector<LandedJet>& landed) {
    const auto found = calibrated(landed);
    return found ? std::string("found") : found.error().message;
  };
  EXPECT_NE(reason(sprayed(kNozzle, 1.0, {.count = 4})).find("4 postures"), std::string::npos);
  EXPECT_NE(reason({}).find("0 postures"), std::string::npos);
  EXPECT_NE(reason(sprayed(kNozzle, 1.0, {.distance_spread_m = 0.02})).find("distances"),
            std::string::npos);
  EXPECT_NE(reason(sprayed(kNozzle, 1.0, {.roll_deg = 5.0})).find("rolled"), std::string::npos);
  auto broken = sprayed(kNozzle, 1.0);
  broken[3].centre_px.x() = std::nan("");
  EXPECT_NE(reason(broken).find("no number"), std::string::npos);
  auto away = sprayed(kNozzle, 1.0);
  away[2].X_base_flange = away[2].X_base_flange * makePose({0, 0, 0}, {0, M_PI, 0});
  EXPECT_NE(reason(away).find("does not reach"), std::string::npos);
}

}  // namespace
}  // namespace kiln
