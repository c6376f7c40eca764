#include "common/geom/camera_model.h"

#include <cmath>

#include <gtest/gtest.h>

#include "common/core/units.h"

namespace kiln {
namespace {

TEST(CameraModel, ProjectsWhatItsRaysHit) {
  const CameraModel camera = CameraModel::fromHorizontalFov(160, 120, 57 * kDeg);
  for (int u = 0; u < camera.width; u += 13) {
    for (int v = 0; v < camera.height; v += 11) {
      const Eigen::Vector2d pixel(u, v);
      const Eigen::Vector3d ray = camera.ray(pixel);
      EXPECT_NEAR(ray.norm(), 1.0, 1e-12);
      const auto back = camera.project(3.7 * ray);
      ASSERT_TRUE(back.has_value());
      EXPECT_NEAR((*back - pixel).norm(), 0.0, 1e-9);
    }
  }
}

TEST(CameraModel, TheFieldOfViewEndsAtTheOuterEdgesOfTheOuterPixels) {
  const CameraModel camera = CameraModel::fromHorizontalFov(160, 120, 57 * kDeg);
  const Eigen::Vector3d left = camera.ray({-0.5, camera.cy}),
                        right = camera.ray({159.5, camera.cy});
  EXPECT_NEAR(std::acos(left.dot(right)), 57 * kDeg, 1e-12);
  EXPECT_LT(left.x(), 0.0) << "X points right";
  EXPECT_GT(camera.ray({0, 119}).y(), 0.0) << "Y points down";
}

TEST(CameraModel, SeesNothingBehindOrBesideItself) {
  const CameraModel camera = CameraModel::fromHorizontalFov(160, 120, 57 * kDeg);
  EXPECT_FALSE(camera.project({0, 0, -1}).has_value());
  EXPECT_FALSE(camera.project({1, 1, 0}).has_value());
  EXPECT_FALSE(camera.project({0, 0, std::nan("")}).has_value());
}

}  // namespace
}  // namespace kiln
