#include "robot/perception/calibration/thermal_calibration.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "common/core/units.h"
#include "common/geom/pose.h"

namespace kiln {
namespace {

/// Camera poses before a plate, as the routine chooses them: aslant, rolled, near and far.
std::vector<PlateSighting> sightingsOf(const Eigen::Isometry3d& X_flange_thermal,
                                       const Eigen::Vector3d& plate, double roll_deg,
                                       double noise_px, int count = 30) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  std::normal_distribution<double> noise(0.0, noise_px);
  const CameraModel camera = CameraModel::fromHorizontalFov(160, 120, 57 * kDeg);
  const Eigen::Isometry3d X_base_plate = thermal::platePose(plate, {-1, 0, 0});
  const Eigen::Isometry3d X_nominal = makePose({-0.06, 0.04, 0.13}, {0, 0, 0});
  std::vector<PlateSighting> out;
  for (int i = 0; i < count; ++i) {
    const double range = 0.95 + 0.15 * unit(random);
    const Eigen::Vector3d from =
        plate + range * Eigen::Vector3d(-1, 0.22 * unit(random), 0.2 * unit(random)).normalized();
    const Eigen::Vector3d z =
        (plate + Eigen::Vector3d(0, 0.1 * unit(random), 0.06 * unit(random)) - from).normalized();
    const Eigen::Vector3d x = z.cross(Eigen::Vector3d::UnitZ()).normalized();
    Eigen::Isometry3d X_base_thermal = Eigen::Isometry3d::Identity();
    X_base_thermal.linear() << x, z.cross(x), z;
    X_base_thermal.translation() = from;
    X_base_thermal.rotate(
        Eigen::AngleAxisd(roll_deg * kDeg * unit(random), Eigen::Vector3d::UnitZ()));
    // The arm brings the nominal camera there; the true one looks from beside it.
    const Eigen::Isometry3d X_base_flange = X_base_thermal * X_nominal.inverse();
    const auto seen =
        thermal::viewPlate({}, camera, (X_base_flange * X_flange_thermal).inverse() * X_base_plate);
    if (seen)
      out.push_back(
          {X_base_flange, seen->centre_px + Eigen::Vector2d(noise(random), noise(random))});
  }
  return out;
}

const Eigen::Isometry3d kNominal = makePose({-0.06, 0.04, 0.13}, {0, 0, 0});

TEST(ThermalCalibration, FindsCameraAndPlateTogether) {
  const Eigen::Isometry3d truth =
      kNominal * makePose({0.006, -0.005, 0.007}, {0.3 * kDeg, -0.4 * kDeg, 0.5 * kDeg});
  const Eigen::Vector3d plate(2.0, 0.1, 1.0);
  const auto sightings = sightingsOf(truth, plate, 70.0, 0.1, 60);
  const auto found =
      ThermalCalibrator({}).calibrate(sightings, kNominal, {2.15, 0, 1.0}, {-1, 0, 0});
  ASSERT_TRUE(found.has_value()) << found.error();
  const auto after = difference(truth, found->flange_thermal.X_parent_sensor);
  EXPECT_LT(after.translation_m, 0.003);
  EXPECT_LT(after.rotation_rad, 0.12 * kDeg);
  EXPECT_LT((found->p_base_plate - plate).norm(), 0.006);
  EXPECT_LT(found->flange_thermal.rms_after, 0.15);
  EXPECT_GT(found->flange_thermal.rms_before, 2.0 * found->flange_thermal.rms_after);
}

TEST(ThermalCalibration, SaysWhatIsMissing) {
  const ThermalCalibrator calibrator{{}};
  const Eigen::Vector3d plate(2.0, 0.1, 1.0);
  const auto few =
      calibrator.calibrate(sightingsOf(kNominal, plate, 70, 0.1, 5), kNominal, plate, {-1, 0, 0});
  ASSERT_FALSE(few.has_value());
  EXPECT_NE(few.error().message.find("5 postures"), std::string::npos) << few.error().message;
  auto same = sightingsOf(kNominal, plate, 70, 0.1, 1);
  same.resize(20, same.front());
  EXPECT_NE(
      calibrator.calibrate(same, kNominal, plate, {-1, 0, 0}).error().message.find("one axis"),
      std::string::npos);
}

}  // namespace
}  // namespace kiln
