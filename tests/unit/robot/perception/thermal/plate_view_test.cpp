#include "robot/perception/thermal/plate_view.h"

#include <gtest/gtest.h>

#include "robot/perception/thermal/heat_detector.h"
#include "tests/support/thermal_renderer.h"

namespace kiln::thermal {
namespace {

using testing::lookAt;

TEST(PlateView, OnAxisIsThePinholeDisc) {
  const CameraModel camera = CameraModel::fromHorizontalFov(160, 120, 57 * M_PI / 180);
  PlateModel model;
  model.psf_sigma_px = 0;
  const auto view = viewPlate(
      model, camera, lookAt({0.9, 0, 0}, {0, 0, 0}).inverse() * platePose({0, 0, 0}, {1, 0, 0}));
  ASSERT_TRUE(view.has_value());
  const double radius = camera.fx * 0.075 / 0.9;
  EXPECT_NEAR(view->area_px, M_PI * radius * radius, 1e-6 * view->area_px);
  EXPECT_NEAR(view->centre_px.x(), 79.5, 1e-9);
  EXPECT_NEAR(view->centre_px.y(), 59.5, 1e-9);
}

TEST(PlateView, NothingFromBehindOrBesideTheOpening) {
  const CameraModel camera = CameraModel::fromHorizontalFov(160, 120, 57 * M_PI / 180);
  const auto X_map_plate = platePose({0, 0, 0}, {1, 0, 0});
  EXPECT_FALSE(
      viewPlate({}, camera, lookAt({-0.9, 0, 0}, {0, 0, 0}).inverse() * X_map_plate).has_value());
  EXPECT_FALSE(
      viewPlate({}, camera, lookAt({0.25, 2.0, 0}, {0, 0, 0}).inverse() * X_map_plate).has_value());
}

/// The model against the renderer and the detector, who know nothing of each other, from many
/// places.
class PlateViewAgainstRenderer : public ::testing::TestWithParam<Eigen::Vector3d> {};

TEST_P(PlateViewAgainstRenderer, CentreAndAreaAgree) {
  testing::ThermalRenderer renderer({.noise_k = 0, .fixed_pattern_k = 0}, 1);
  testing::ThermalScene scene;
  scene.X_map_plate = platePose({0, 0, 0}, {1, 0, 0});
  const Eigen::Isometry3d X_map_camera = lookAt(GetParam(), {0.05, 0.08, -0.05});
  const HeatDetections found = HeatDetector({}).detect(renderer.render(scene, X_map_camera));
  const auto view = viewPlate({}, renderer.camera(), X_map_camera.inverse() * scene.X_map_plate);
  ASSERT_EQ(found.blobs.size(), 1u);
  ASSERT_TRUE(view.has_value());
  EXPECT_NEAR(found.blobs[0].u, view->centre_px.x(), 0.1);
  EXPECT_NEAR(found.blobs[0].v, view->centre_px.y(), 0.1);
  // 2 % of the area is 1 % of the range
  EXPECT_NEAR(found.blobs[0].half_max_area_px / view->area_px, 1.0, 0.02);
}
INSTANTIATE_TEST_SUITE_P(
    Places, PlateViewAgainstRenderer,
    ::testing::Values(Eigen::Vector3d(0.9, 0, 0), Eigen::Vector3d(0.9, 0.16, 0),
                      Eigen::Vector3d(0.9, -0.3, 0.1), Eigen::Vector3d(0.6, 0, -0.2),
                      Eigen::Vector3d(1.5, 0.4, 0.3), Eigen::Vector3d(0.7, 0.35, 0.0),
                      Eigen::Vector3d(2.5, 0.2, 0.1)));

}  // namespace
}  // namespace kiln::thermal
