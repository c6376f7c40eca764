#include "robot/scene/raycaster.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "common/core/units.h"
#include "common/geom/pose.h"
#include "robot/scene/primitive_meshes.h"

namespace kiln {
namespace {

Eigen::Isometry3d at(double x, double y, double z) {
  return Eigen::Isometry3d(Eigen::Translation3d(x, y, z));
}

Raycaster::Hit castOne(const Raycaster& scene, const Raycaster::Ray& ray) {
  Raycaster::Hit hit;
  scene.cast({&ray, 1}, {&hit, 1});
  return hit;
}

/// Slab test, the textbook way: the oracle for random boxes and rays.
double boxRange(const Eigen::Vector3d& size, const Eigen::Isometry3d& X,
                const Eigen::Vector3d& origin, const Eigen::Vector3d& direction) {
  const Eigen::Vector3d o = X.inverse() * origin, d = X.linear().transpose() * direction;
  double near = -1e30, far = 1e30;
  for (int i = 0; i < 3; ++i) {
    const double a = (-0.5 * size[i] - o[i]) / d[i], b = (0.5 * size[i] - o[i]) / d[i];
    near = std::max(near, std::min(a, b));
    far = std::min(far, std::max(a, b));
  }
  return near <= far && far > 0 ? (near > 0 ? near : far) : -1.0;
}

TEST(Raycaster, RandomRaysAtATurnedBoxAgreeWithTheSlabTest) {
  const Eigen::Vector3d size(0.4, 1.2, 0.7);
  const Eigen::Isometry3d X = makePose({2.0, -0.5, 0.3}, {0.3, -0.8, 1.9});
  Raycaster scene;
  const auto box = scene.addBox(size, X, 7);
  scene.commit();
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  std::vector<Raycaster::Ray> rays(1003);  // no multiple of the packet
  for (Raycaster::Ray& ray : rays) {
    const Eigen::Vector3d aim =
        X.translation() + 0.6 * Eigen::Vector3d(normal(random), normal(random), normal(random));
    ray.origin = Eigen::Vector3f(static_cast<float>(-normal(random)),
                                 static_cast<float>(normal(random)), 0.2F);
    ray.direction = (aim.cast<float>() - ray.origin).normalized();
  }
  std::vector<Raycaster::Hit> hits(rays.size());
  scene.cast(rays, hits);
  int met = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const double expected =
        boxRange(size, X, rays[i].origin.cast<double>(), rays[i].direction.cast<double>());
    ASSERT_EQ(hits[i].valid(), expected > 0) << i;
    if (!hits[i].valid()) continue;
    ++met;
    EXPECT_NEAR(hits[i].range, expected, 1e-4);
    EXPECT_EQ(hits[i].instance, box);
    EXPECT_EQ(hits[i].material, 7u);
    EXPECT_LE(hits[i].normal.dot(rays[i].direction), 0.0F);
    EXPECT_NEAR(hits[i].normal.norm(), 1.0, 1e-5);
  }
  EXPECT_GT(met, 300);
}

TEST(Raycaster, NormalsOfAScaledCylinderPointAwayFromItsAxis) {
  Raycaster scene;
  scene.addCylinder(0.5, 3.0, at(4, 0, 0), 1);
  scene.commit();
  const auto hit = castOne(scene, {{0, 0.1F, 0.7F}, {1, 0, 0}, 100.0F, 1});
  ASSERT_TRUE(hit.valid());
  // 32 sides: the surface lies at most r (1 - cos(pi / 32)) = 2.4 mm inside the true circle.
  EXPECT_NEAR(hit.range, 4.0 - std::sqrt(0.25 - 0.01), 0.003);
  EXPECT_LT(hit.normal.x(), -0.95F);
  EXPECT_NEAR(hit.normal.z(), 0.0F, 1e-5);
}

TEST(Raycaster, MaskDecidesWhichRaysPass) {
  Raycaster scene;
  const auto pane = scene.addBox({0.01, 1, 1}, at(1, 0, 0), 1, 0b10);
  scene.addBox({0.01, 1, 1}, at(2, 0, 0), 2, 0b01);
  scene.commit();
  EXPECT_EQ(castOne(scene, {{0, 0, 0}, {1, 0, 0}, 10.0F, 0b11}).material, 1u);
  EXPECT_EQ(castOne(scene, {{0, 0, 0}, {1, 0, 0}, 10.0F, 0b01}).material, 2u);
  scene.setMask(pane, 0);
  scene.commit();
  EXPECT_EQ(castOne(scene, {{0, 0, 0}, {1, 0, 0}, 10.0F, 0b11}).material, 2u);
}

TEST(Raycaster, MovedInstanceIsMetWhereItWasPut) {
  Raycaster scene;
  const auto ball = scene.addSphere(0.2, {5, 0, 0}, 1);
  scene.commit();
  EXPECT_NEAR(castOne(scene, {{0, 0, 0}, {1, 0, 0}, 10.0F, 1}).range, 4.8, 0.01);
  scene.setPose(ball, at(0, 3, 0));
  scene.commit();
  EXPECT_FALSE(castOne(scene, {{0, 0, 0}, {1, 0, 0}, 10.0F, 1}).valid());
  EXPECT_NEAR(castOne(scene, {{0, 0, 0}, {0, 1, 0}, 10.0F, 1}).range, 2.8, 0.01);
}

TEST(Raycaster, NothingBeyondMaxRange) {
  Raycaster scene;
  scene.addBox({1, 1, 1}, at(5, 0, 0), 1);
  scene.commit();
  const std::vector<Raycaster::Ray> rays = {{{0, 0, 0}, {1, 0, 0}, 4.4F, 1},
                                            {{0, 0, 0}, {1, 0, 0}, 4.6F, 1}};
  std::vector<std::uint8_t> blocked(2);
  scene.occluded(rays, blocked);
  EXPECT_EQ(blocked[0], 0);
  EXPECT_EQ(blocked[1], 1);
  EXPECT_FALSE(castOne(scene, rays[0]).valid());
}

TEST(Raycaster, ABoxWithCutEdgesIsTheBoxWithoutThem) {
  const Eigen::Vector3d size(0.4, 0.6, 0.8);
  const TriangleMesh mesh = cutBox(size, 0.05);
  Raycaster scene;
  scene.addMesh(mesh.vertices, mesh.triangles, Eigen::Isometry3d::Identity(), 1);
  scene.commit();
  const auto along = [&](double y, double z) {
    return castOne(scene, {{2.0F, static_cast<float>(y), static_cast<float>(z)}, {-1, 0, 0}});
  };
  EXPECT_NEAR(along(0.0, 0.0).range, 1.8, 1e-5);
  EXPECT_NEAR(along(0.24, 0.34).range, 1.8, 1e-5) << "5 cm from two edges";
  EXPECT_NEAR(along(0.28, 0.0).range, 1.83, 1e-5) << "3 of 5 cm into the cut";
  EXPECT_NEAR(along(0.28, 0.0).normal.y(), M_SQRT1_2, 1e-5);
  EXPECT_FALSE(along(0.295, 0.395).valid()) << "the corner is gone";
  EXPECT_FALSE(along(0.301, 0.0).valid());
  // Closed: every ray from the middle meets it once.
  std::mt19937_64 random(3);
  std::normal_distribution<double> axis;
  for (int i = 0; i < 2000; ++i) {
    const Eigen::Vector3d d =
        Eigen::Vector3d(axis(random), axis(random), axis(random)).normalized();
    const auto hit = castOne(scene, {Eigen::Vector3f::Zero(), d.cast<float>()});
    ASSERT_TRUE(hit.valid());
    const double full = 0.5 / (d.cwiseAbs().array() / size.array()).maxCoeff();
    ASSERT_LE(hit.range, full + 1e-5);
    ASSERT_GE(hit.range, full - 0.05 * std::sqrt(3.0));
  }
}

TEST(Raycaster, APlateWithARoundHoleLetsPassWhatMeetsTheHole) {
  const TriangleMesh mesh = holedPlate(0.075, Outline::Square, 0.175, 0.005);
  Raycaster scene;
  scene.addMesh(mesh.vertices, mesh.triangles, Eigen::Isometry3d::Identity(), 1);
  scene.commit();
  for (int i = 0; i < 360; ++i) {
    const double angle = (i + 0.3) * kDeg;  // between the edges of triangles
    const auto at_radius = [&](double r) {
      return castOne(scene, {{1.0F, static_cast<float>(r * std::cos(angle)),
                              static_cast<float>(r * std::sin(angle))},
                             {-1, 0, 0}});
    };
    ASSERT_FALSE(at_radius(0.0745).valid()) << i;
    ASSERT_TRUE(at_radius(0.0755).valid()) << i;
    const double edge = 0.175 / std::max(std::fabs(std::cos(angle)), std::fabs(std::sin(angle)));
    ASSERT_TRUE(at_radius(edge - 0.0005).valid()) << i;
    ASSERT_FALSE(at_radius(edge + 0.0005).valid()) << i;
  }
}

TEST(Raycaster, MeshIsMetFromBothSides) {
  const std::vector<Eigen::Vector3f> vertices = {{0, -1, -1}, {0, 1, -1}, {0, 0, 1}};
  const std::vector<Eigen::Vector3i> triangles = {{0, 1, 2}};
  Raycaster scene;
  scene.addMesh(vertices, triangles, at(2, 0, 0), 9);
  scene.commit();
  EXPECT_NEAR(castOne(scene, {{0, 0, 0}, {1, 0, 0}, 10.0F, 1}).range, 2.0, 1e-5);
  EXPECT_NEAR(castOne(scene, {{4, 0, 0}, {-1, 0, 0}, 10.0F, 1}).range, 2.0, 1e-5);
}

}  // namespace
}  // namespace kiln
