#include "robot/planning/arm_motion/shapes.h"

#include <random>

#include <gtest/gtest.h>

#include "common/geom/pose.h"

namespace kiln {
namespace {

class RandomShapes {
 public:
  double unit() { return unit_(random_); }
  Eigen::Vector3d point(double scale) { return scale * Eigen::Vector3d(unit(), unit(), unit()); }
  OrientedBox box() {
    const Eigen::Vector3d size = point(0.4).cwiseAbs() + Eigen::Vector3d::Constant(0.05);
    return makeBox(makePose(point(0.8), point(M_PI)), size, "box");
  }

 private:
  std::mt19937 random_{21};
  std::uniform_real_distribution<double> unit_{-1.0, 1.0};
};

TEST(Shapes, SignedDistanceOfPointsToABox) {
  const Eigen::Vector3d half(1, 2, 3);
  EXPECT_DOUBLE_EQ(signedDistance({2, 0, 0}, half), 1.0);
  EXPECT_DOUBLE_EQ(signedDistance({4, 6, 3}, half), 5.0);  // 3-4-5 from the edge
  EXPECT_DOUBLE_EQ(signedDistance({0.5, 0, 0}, half), -0.5);
}

TEST(Shapes, CapsuleToBoxAgreesWithDenseSampling) {
  RandomShapes random;
  for (int k = 0; k < 500; ++k) {
    const OrientedBox box = random.box();
    const Capsule capsule{random.point(1.0), random.point(1.0), 0.05};
    double sampled = INFINITY;
    for (int i = 0; i <= 2000; ++i) {
      const Eigen::Vector3d p = capsule.a + (capsule.b - capsule.a) * (i / 2000.0);
      sampled = std::min(sampled, signedDistance(box.X_frame_box.inverse() * p, box.half));
    }
    if (sampled > 0.05)
      ASSERT_NEAR(distance(capsule, box), sampled - 0.05, 1e-3);
    else
      ASSERT_LE(distance(capsule, box), sampled - 0.05 + 1e-3) << "how deep, not how near its axis";
  }
}

TEST(Shapes, CapsuleToCapsuleAgreesWithDenseSampling) {
  RandomShapes random;
  for (int k = 0; k < 300; ++k) {
    const Capsule a{random.point(1.0), random.point(1.0), 0.03};
    const Capsule b{random.point(1.0), random.point(1.0), 0.04};
    double sampled = INFINITY;
    for (int i = 0; i <= 200; ++i) {
      for (int j = 0; j <= 200; ++j) {
        const Eigen::Vector3d p = a.a + (a.b - a.a) * (i / 200.0);
        const Eigen::Vector3d q = b.a + (b.b - b.a) * (j / 200.0);
        sampled = std::min(sampled, (p - q).norm());
      }
    }
    ASSERT_LE(distance(a, b), sampled - 0.07 + 1e-6);
    if (sampled > 0.07 + 0.02) {
      ASSERT_NEAR(distance(a, b), sampled - 0.07, 0.02);
    }
  }
}

TEST(Shapes, ParallelCapsules) {
  const Capsule a{{0, 0, 0}, {1, 0, 0}, 0.1};
  EXPECT_NEAR(distance(a, {{0.5, 1, 0}, {2, 1, 0}, 0.1}), 0.8, 1e-6);
  EXPECT_NEAR(distance(a, {{3, 0, 0}, {2, 0, 0}, 0.1}), 0.8, 1e-6);
}

TEST(Shapes, BoxToBoxNeverExceedsSampledDistancesAndTellsOverlap) {
  RandomShapes random;
  int apart = 0, overlapping = 0;
  for (int k = 0; k < 400; ++k) {
    const OrientedBox a = random.box(), b = random.box();
    // Points of b against a bound the true distance from above.
    double sampled = INFINITY;
    for (int i = 0; i < 3000; ++i) {
      Eigen::Vector3d p = random.point(1.0).cwiseProduct(b.half);
      if (i % 2 == 0) p[i / 2 % 3] = p[i / 2 % 3] < 0 ? -b.half[i / 2 % 3] : b.half[i / 2 % 3];
      sampled =
          std::min(sampled, signedDistance(a.X_frame_box.inverse() * (b.X_frame_box * p), a.half));
    }
    const double gap = distance(a, b);
    if (sampled < 0) {
      ++overlapping;
      ASSERT_LT(gap, 0.0);
    } else {
      apart += gap > 0 ? 1 : 0;
      ASSERT_LE(gap, sampled + 1e-6);
    }
  }
  EXPECT_GT(apart, 50);
  EXPECT_GT(overlapping, 5);
}

TEST(Shapes, BoxesFaceToFace) {
  const auto at = [](double x) {
    return makeBox(makePose({x, 0, 0}, Eigen::Vector3d::Zero()), {1, 1, 1}, "");
  };
  EXPECT_NEAR(distance(at(0), at(1.25)), 0.25, 1e-6);
  EXPECT_NEAR(distance(at(0), at(0.9)), -0.1, 1e-6);
}

}  // namespace
}  // namespace kiln
