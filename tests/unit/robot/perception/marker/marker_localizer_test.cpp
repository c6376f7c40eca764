#include "robot/perception/marker/marker_localizer.h"

#include <cmath>

#include <gtest/gtest.h>

#include "common/core/units.h"
#include "robot/perception/marker/marker_shape.h"
#include "tests/unit/robot/perception/marker/drawn_picture.h"

namespace kiln {
namespace {

/// What a test puts on the ground, in the wall frame: true where the marker shows.
using Shown = std::function<bool(double x, double y)>;
const Shown kWhole = [](double, double) { return true; };

/// A camera 1.9 m up that looks `tilt` down and `pan` aside.
Eigen::Isometry3d looking(double pan_deg, double tilt_deg) {
  const double pan = pan_deg * kDeg, tilt = tilt_deg * kDeg;
  Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
  const Eigen::Vector3d view(std::cos(tilt) * std::cos(pan), std::cos(tilt) * std::sin(pan),
                             -std::sin(tilt));
  const Eigen::Vector3d right(std::sin(pan), -std::cos(pan), 0.0);
  X.linear() << right, view.cross(right), view;
  X.translation() = Eigen::Vector3d(0.9, 0.0, 1.9);
  return X;
}

/// A clean picture of the marker on flat ground z = 0 of base.
MarkerView pictureOf(const Pose2& X_base_wall, const Eigen::Isometry3d& X_base_rgb,
                     const Shown& shown, double stamp_s = 1.0, double scale = 1.0) {
  const CameraModel camera = CameraModel::fromHorizontalFov(1280, 720, kHeadCameraHfov_deg * kDeg);
  RgbImage image = testing::draw([&](int u, int v) {
    const Eigen::Vector3d ray = X_base_rgb.linear() * camera.ray({u, v});
    if (ray.z() > -1e-3) return testing::kGrey;
    const Eigen::Vector3d p =
        X_base_rgb.translation() - X_base_rgb.translation().z() / ray.z() * ray;
    const Pose2 in = inverse(X_base_wall) * Pose2{p.x(), p.y(), 0.0};
    const double x = in.x_m / scale, y = in.y_m / scale;
    if (marker::distanceOutside({x, y}) > 0.0 || !shown(x, y)) return testing::kGrey;
    const int parity =
        static_cast<int>(std::floor((x + 9.99) / 0.1) + std::floor((y + 9.99) / 0.1));
    return parity % 2 == 0 ? testing::kMagentaPaint : testing::kYellowPaint;
  });
  image.stamp = stampFromNanoseconds(0) + fromSeconds(stamp_s);
  return MarkerDetector({}).detect(image);
}

MarkerViewpoint from(const Eigen::Isometry3d& X_base_rgb, const Pose2& X_odom_base = {}) {
  MarkerViewpoint out;
  out.X_base_rgb = X_base_rgb;
  out.X_odom_base = X_odom_base;
  const double tilt = 0.3 * kDeg;
  out.ground.covariance = Eigen::Vector3d(2.5e-5, tilt * tilt, tilt * tilt).asDiagonal();
  return out;
}

MarkerSearch searchOne(const MarkerView& view, const MarkerViewpoint& viewpoint,
                       const MarkerLocalizer::Config& config = {}) {
  MarkerLocalizer localizer(config);
  localizer.add(view, viewpoint);
  return localizer.search();
}

std::string whyNot(const MarkerSearch& search) {
  std::string all;
  for (const RefusedMarker& refused : search.refused)
    all += std::string(toString(refused.why)) + ": " + refused.text + "\n";
  return all;
}

void expectAt(const MarkerSearch& search, const Pose2& truth, double within_m, double within_deg) {
  ASSERT_TRUE(search.estimate) << whyNot(search);
  const Pose2 found = projectToGround(search.estimate->X_base_wall);
  EXPECT_NEAR(found.x_m, truth.x_m, within_m);
  EXPECT_NEAR(found.y_m, truth.y_m, within_m);
  EXPECT_NEAR(wrapAngle(found.yaw_rad - truth.yaw_rad) / kDeg, 0.0, within_deg);
}

/// Wall frame of a marker whose square has its middle at (x, y).
Pose2 around(double x, double y, double yaw) {
  return Pose2{x, y, yaw} * Pose2{-0.5 * kMarkerLength_m, -0.5 * kMarkerLength_m, 0.0};
}

TEST(MarkerLocalizer, PoseOfTheWallFrameWhicheverWayTheMarkerLies) {
  const Eigen::Isometry3d X = looking(0.0, 15.0);
  for (int degrees = -180; degrees < 180; degrees += 40) {
    const Pose2 truth = around(7.0, 0.3, degrees * kDeg);
    SCOPED_TRACE(degrees);
    expectAt(searchOne(pictureOf(truth, X, kWhole), from(X)), truth, 0.05, 0.7);
  }
}

TEST(MarkerLocalizer, CameraThatLooksWhereItIsNotBelievedToLook) {
  const Pose2 truth = around(9.0, 0.0, 0.4);
  const MarkerView view = pictureOf(truth, looking(0.0, 12.0), kWhole);
  const MarkerViewpoint wrong = from(looking(0.0, 12.5));
  MarkerLocalizer::Config rectangle;
  rectangle.refine = false;
  const MarkerSearch rough = searchOne(view, wrong, rectangle);
  ASSERT_TRUE(rough.estimate) << whyNot(rough);
  // d squared over height times the angle: 9 m, 1.9 m and half a degree make about 0.3 m.
  EXPECT_GT(std::abs(projectToGround(rough.estimate->X_base_wall).x_m - truth.x_m), 0.2);
  const MarkerSearch fine = searchOne(view, wrong);
  expectAt(fine, truth, 0.08, 1.0);
  EXPECT_LT(std::abs(projectToGround(fine.estimate->X_base_wall).x_m - truth.x_m),
            3.0 * std::sqrt(fine.estimate->covariance(0, 0)));
}

TEST(MarkerLocalizer, BaseThatPitchesNeedsTheGroundOfTheLidar) {
  // The base stands on a slope of 3 degrees and looks at level ground: in base the ground sinks.
  const double pitch = 3.0 * kDeg;
  const Pose2 level = around(7.0, 0.0, 0.5);
  const Eigen::Isometry3d X_level_rgb = looking(0.0, 15.0);
  const MarkerView view = pictureOf(level, X_level_rgb, kWhole);
  const Eigen::Isometry3d X_base_level = makePose(Eigen::Vector3d::Zero(), {0.0, pitch, 0.0});
  MarkerViewpoint viewpoint = from(X_base_level * X_level_rgb);
  viewpoint.ground.coefficients = {0.0, -std::tan(pitch), 0.0};
  const MarkerSearch search = searchOne(view, viewpoint);
  ASSERT_TRUE(search.estimate) << whyNot(search);
  const Eigen::Vector3d truth = X_base_level * toIsometry(level).translation();
  EXPECT_LT((search.estimate->X_base_wall.translation() - truth).norm(), 0.06);

  MarkerLocalizer::Config paper;
  paper.paper = true;
  paper.refine = false;
  viewpoint.ground = GroundPlane::flat();
  const MarkerSearch flat = searchOne(view, viewpoint, paper);
  EXPECT_TRUE(!flat.estimate || (flat.estimate->X_base_wall.translation() - truth).norm() > 0.5);
}

TEST(MarkerLocalizer, OneLegIsNoMarker) {
  const Eigen::Isometry3d X = looking(0.0, 15.0);
  const MarkerSearch search = searchOne(
      pictureOf(around(7.0, 0.0, 0.2), X, [](double, double y) { return y <= 0.42; }), from(X));
  ASSERT_FALSE(search.estimate);
  ASSERT_FALSE(search.refused.empty());
  EXPECT_EQ(search.refused[0].why, MarkerRefusal::OneLeg) << whyNot(search);
}

TEST(MarkerLocalizer, HalfHiddenGivesNoPose) {
  const Eigen::Isometry3d X = looking(0.0, 15.0);
  const Pose2 truth = around(7.0, 0.0, 0.8);
  const std::vector<std::pair<const char*, Shown>> hidden{
      {"end of a leg", [](double x, double) { return x < 2.2; }},
      {"middle of a leg", [](double x, double) { return x < 0.9 || x > 3.4; }},
      {"corner", [](double x, double y) { return x > 1.6 || y > 1.6; }},
      {"near half of both", [](double x, double y) { return x + y > 2.0; }},
      {"far half of both", [](double x, double y) { return x + y < 2.4; }},
  };
  for (const auto& [what, shown] : hidden) {
    const MarkerSearch search = searchOne(pictureOf(truth, X, shown), from(X));
    EXPECT_FALSE(search.estimate) << what;
    EXPECT_FALSE(search.refused.empty()) << what;
  }
}

TEST(MarkerLocalizer, SmallOneIsTooSmall) {
  const Eigen::Isometry3d X = looking(0.0, 20.0);
  const MarkerSearch search =
      searchOne(pictureOf(Pose2{4.0, 0.0, 0.3}, X, kWhole, 1.0, 0.6), from(X));
  ASSERT_FALSE(search.estimate);
  ASSERT_FALSE(search.refused.empty());
  EXPECT_EQ(search.refused[0].why, MarkerRefusal::TooSmall) << whyNot(search);
}

TEST(MarkerLocalizer, NothingSeenIsSaid) {
  const Eigen::Isometry3d X = looking(0.0, 15.0);
  const MarkerSearch search =
      searchOne(pictureOf(around(7.0, 0.0, 0.0), X, [](double, double) { return false; }), from(X));
  ASSERT_EQ(search.refused.size(), 1U);
  EXPECT_EQ(search.refused[0].why, MarkerRefusal::NothingSeen);
  EXPECT_NE(search.refused[0].text.find("1 picture"), std::string::npos);
}

TEST(MarkerLocalizer, PicturesThatShowAPieceEachMakeAWhole) {
  // The marker is nearer and wider than the picture; the head turns, the base moves on.
  MarkerLocalizer localizer({});
  const Pose2 truth = around(5.0, 0.0, -2.2);  // in odom
  int i = 0;
  for (const double pan : {35.0, 15.0, -15.0, -35.0}) {
    const Pose2 X_odom_base{0.05 * i, 0.02 * i, 0.01 * i};
    const Eigen::Isometry3d X = looking(pan, 30.0);
    const MarkerView view = pictureOf(inverse(X_odom_base) * truth, X, kWhole, 1.0 + 0.1 * i);
    if (i == 0) {
      EXPECT_FALSE(searchOne(view, from(X, X_odom_base)).estimate);  // no picture shows all of it
    }
    localizer.add(view, from(X, X_odom_base));
    ++i;
  }
  const MarkerSearch search = localizer.search();
  ASSERT_TRUE(search.estimate) << whyNot(search);
  EXPECT_NEAR(search.estimate->X_odom_wall.x_m, truth.x_m, 0.05);
  EXPECT_NEAR(search.estimate->X_odom_wall.y_m, truth.y_m, 0.05);
  EXPECT_EQ(search.estimate->pictures, 4);
}

TEST(MarkerLocalizer, ForgetsWhatIsOlderThanTheWindowOrTooMuch) {
  MarkerLocalizer::Config config;
  config.max_pictures = 3;
  MarkerLocalizer localizer(config);
  const Eigen::Isometry3d X = looking(0.0, 15.0);
  const Pose2 truth = around(7.0, 0.0, 0.3);
  const MarkerView whole = pictureOf(truth, X, kWhole);
  MarkerView blank = pictureOf(truth, X, [](double, double) { return false; });
  localizer.add(whole, from(X));
  EXPECT_TRUE(localizer.search().estimate);
  localizer.add(whole, from(X));  // the same stamp again
  blank.stamp = whole.stamp + fromSeconds(9.0);
  localizer.add(blank, from(X));
  const auto still = localizer.search();
  ASSERT_TRUE(still.estimate);
  EXPECT_EQ(still.estimate->pictures, 2);
  blank.stamp = whole.stamp + fromSeconds(10.5);
  localizer.add(blank, from(X));
  EXPECT_FALSE(localizer.search().estimate);

  localizer.reset();
  localizer.add(whole, from(X));
  for (int i = 1; i <= 3; ++i) {
    blank.stamp = whole.stamp + fromSeconds(0.1 * i);
    localizer.add(blank, from(X));
  }
  EXPECT_FALSE(localizer.search().estimate);  // four pictures, three are kept
}

TEST(MarkerLocalizer, ViewpointThatIsNoNumberIsLeftOut) {
  const Eigen::Isometry3d X = looking(0.0, 15.0);
  MarkerViewpoint broken = from(X);
  broken.X_odom_base.x_m = std::nan("");
  EXPECT_FALSE(searchOne(pictureOf(around(7.0, 0.0, 0.0), X, kWhole), broken).estimate);
}

}  // namespace
}  // namespace kiln
