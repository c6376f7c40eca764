#include "robot/perception/marker/outline_fit.h"

#include <cmath>
#include <random>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "common/core/units.h"
#include "robot/perception/marker/marker_shape.h"

namespace kiln::marker {
namespace {

constexpr double kFocal_px = 790.0;

/// Camera 1.9 m up, 12 degrees down, nothing turned.
PictureFrame levelFrame() {
  PictureFrame frame;
  const double tilt = 12.0 * kDeg;
  const Eigen::Vector3d view(std::cos(tilt), 0.0, -std::sin(tilt)), right(0.0, -1.0, 0.0);
  frame.X_level_rgb.linear() << right, view.cross(right), view;
  frame.X_level_rgb.translation() = Eigen::Vector3d(0.95, 0.0, 1.9);
  return frame;
}

/// What a camera that is turned by `turn` sees of the outline: points 5 cm apart, with noise.
std::vector<SeenOutline> outlineFrom(const PictureFrame& frame, const Pose2& X_odom_wall,
                                     const Eigen::Vector3d& turn, double sigma_px,
                                     std::mt19937& random) {
  std::normal_distribution<double> noise(0.0, 1.0);
  Eigen::Isometry3d X = frame.X_level_rgb;
  if (turn.norm() > 0.0)
    X.linear() = X.linear() * Eigen::AngleAxisd(turn.norm(), turn.normalized()).toRotationMatrix();
  const Eigen::Isometry3d X_rgb_wall =
      X.inverse() * toIsometry(inverse(frame.X_odom_level) * X_odom_wall);
  const auto pixel = [&](const Eigen::Vector2d& p) {
    const Eigen::Vector3d c = X_rgb_wall * Eigen::Vector3d(p.x(), p.y(), 0.0);
    return Eigen::Vector2d(kFocal_px * c.head<2>() / c.z());
  };
  std::vector<SeenOutline> out;
  for (const Side& side : sides()) {
    const Eigen::Vector2d along = (side.to - side.from).normalized();
    for (double t = 0.025; t < (side.to - side.from).norm(); t += 0.05) {
      const Eigen::Vector2d p = side.from + t * along;
      const Eigen::Vector2d tangent = (pixel(p + 0.01 * along) - pixel(p)).normalized();
      Eigen::Vector2d outward(tangent.y(), -tangent.x());
      if (outward.dot(pixel(p + 0.01 * side.outward) - pixel(p)) < 0.0) outward = -outward;
      const Eigen::Vector2d seen = pixel(p) + sigma_px * noise(random) * outward;
      out.push_back({0, {seen.x() / kFocal_px, seen.y() / kFocal_px, 1.0}, outward, kFocal_px});
    }
  }
  return out;
}

OutlinePrior prior() {
  OutlinePrior out;
  out.camera_rad = 0.3 * kDeg;
  out.camera_m = 0.0;
  out.ground = Eigen::Vector3d(5e-5, 2.7e-5, 2.7e-5).asDiagonal();
  return out;
}

TEST(OutlineFit, SizeTellsTheDistanceThoughTheCameraIsTurned) {
  std::mt19937 random(1);
  const std::vector<PictureFrame> frames{levelFrame()};
  const Pose2 truth{8.0, -1.0, 0.6};
  const auto seen = outlineFrom(frames[0], truth, {0.6 * kDeg, 0.0, 0.0}, 0.3, random);
  // Half a degree is 0.3 m in distance here; that is where the rectangle would begin.
  const OutlineFit fit = fitOutline(frames, seen, {7.7, -0.9, 0.62}, prior(), {});
  ASSERT_TRUE(fit.converged);
  EXPECT_NEAR(fit.X_odom_wall.x_m, truth.x_m, 0.05);
  EXPECT_NEAR(fit.X_odom_wall.y_m, truth.y_m, 0.05);
  EXPECT_NEAR(fit.X_odom_wall.yaw_rad, truth.yaw_rad, 0.5 * kDeg);
  EXPECT_GT(fit.agreeing_share, 0.95);
}

TEST(OutlineFit, EveryDirectionOfTheMarkerIsRecovered) {
  std::mt19937 random(2);
  const std::vector<PictureFrame> frames{levelFrame()};
  for (int degrees = -170; degrees < 180; degrees += 20) {
    const Pose2 truth{9.0, 0.5, degrees * kDeg};
    const auto seen = outlineFrom(frames[0], truth, Eigen::Vector3d::Zero(), 0.3, random);
    const OutlineFit fit =
        fitOutline(frames, seen, truth * Pose2{0.15, -0.1, 2.0 * kDeg}, prior(), {});
    ASSERT_TRUE(fit.converged) << degrees;
    EXPECT_NEAR(fit.X_odom_wall.x_m, truth.x_m, 0.05) << degrees;
    EXPECT_NEAR(fit.X_odom_wall.y_m, truth.y_m, 0.03) << degrees;
    EXPECT_NEAR(wrapAngle(fit.X_odom_wall.yaw_rad - truth.yaw_rad), 0.0, 0.5 * kDeg) << degrees;
  }
}

// Turns drawn from the prior, noise as configured: the squared error, weighed with the covariance
// that the fit claims, is 3 in the mean (chi squared with 3 degrees of freedom). Independent noise
// is more than the fit believes (independent_points), so claims too much is what must not happen.
TEST(OutlineFit, CovarianceIsNotTooConfident) {
  std::mt19937 random(3);
  std::normal_distribution<double> normal(0.0, 0.3 * kDeg);
  const std::vector<PictureFrame> frames{levelFrame()};
  double sum = 0.0;
  constexpr int kTrials = 60;
  for (int i = 0; i < kTrials; ++i) {
    const Pose2 truth{8.0, 0.0, 0.1 * i};
    const double a = normal(random), b = normal(random), c = normal(random);
    const auto seen = outlineFrom(frames[0], truth, {a, b, c}, 1.0, random);
    const OutlineFit fit = fitOutline(frames, seen, truth, prior(), {});
    ASSERT_TRUE(fit.converged);
    const Eigen::Vector3d off(fit.X_odom_wall.x_m - truth.x_m, fit.X_odom_wall.y_m - truth.y_m,
                              wrapAngle(fit.X_odom_wall.yaw_rad - truth.yaw_rad));
    sum += off.dot(fit.covariance.inverse() * off);
  }
  EXPECT_LT(sum / kTrials, 4.0);
  EXPECT_GT(sum / kTrials, 0.3);
}

TEST(OutlineFit, TooLittleToFitIsNoResult) {
  const std::vector<PictureFrame> frames{levelFrame()};
  EXPECT_FALSE(fitOutline(frames, {}, {8.0, 0.0, 0.0}, prior(), {}).converged);
}

}  // namespace
}  // namespace kiln::marker
