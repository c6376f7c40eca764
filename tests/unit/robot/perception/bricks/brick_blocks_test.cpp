#include "robot/perception/bricks/brick_blocks.h"

#include <random>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

namespace kiln {
namespace {

using RowMajor4 = Eigen::Matrix<double, Eigen::Dynamic, 4, Eigen::RowMajor>;

BrickBlock randomBlock(std::mt19937& random, std::size_t rows) {
  std::normal_distribution<double> normal(0.0, 1.0);
  const auto vector = [&] {
    return Eigen::Vector3d(normal(random), normal(random), normal(random));
  };
  BrickBlock block;
  block.centre = vector();
  for (std::size_t i = 0; i < rows; ++i)
    block.correspondences.push_back(
        {vector(), vector(), vector().normalized(), 0.1 + std::abs(normal(random))});
  return block;
}

TEST(BrickBlock, JacobianIsThatOfTheResiduals) {
  std::mt19937 random(3);
  BrickBlock block = randomBlock(random, 20);
  block.hold = {0.7, {0.3, 0.4, 0.5}};
  ASSERT_EQ(block.residuals(), 24);
  const UprightMotion motion(0.4, 0.1, -0.2, 0.3);
  RowMajor4 jacobian(24, 4);
  Eigen::VectorXd residuals(24);
  block.evaluate(motion.data(), residuals.data(), jacobian.data());
  const double step = 1e-6;
  for (int k = 0; k < 4; ++k) {
    UprightMotion up = motion, down = motion;
    up[k] += step;
    down[k] -= step;
    Eigen::VectorXd a(24), b(24);
    block.evaluate(up.data(), a.data(), nullptr);
    block.evaluate(down.data(), b.data(), nullptr);
    EXPECT_LT(((a - b) / (2 * step) - jacobian.col(k)).norm(), 1e-7) << "parameter " << k;
  }
}

TEST(BrickBlock, SquaresAddUpToTheWeightedMean) {
  std::mt19937 random(4);
  BrickBlock block = randomBlock(random, 12);
  const UprightMotion still = UprightMotion::Zero();
  Eigen::VectorXd residuals(16);
  block.evaluate(still.data(), residuals.data(), nullptr);
  double sum = 0.0, weights = 0.0;
  for (const Correspondence& c : block.correspondences) {
    sum += c.weight * std::pow(c.n.dot(c.p - c.q), 2);
    weights += c.weight;
  }
  EXPECT_NEAR(residuals.squaredNorm(), sum / weights, 1e-12);
  block.min_weight = 1e3;  // a brick of few points does not shout
  block.evaluate(still.data(), residuals.data(), nullptr);
  EXPECT_NEAR(residuals.squaredNorm(), sum / 1e3, 1e-12);
}

TEST(PairBlock, JacobiansAreThoseOfTheResiduals) {
  const PairBlock block{{0.1, -0.3, 0.2}, {2.0, {3.0, 5.0, 7.0}}};
  const UprightMotion a(0.3, 0.01, 0.02, -0.01), b(-0.2, -0.02, 0.03, 0.02);
  Eigen::Vector4d residuals;
  Eigen::Matrix<double, 4, 4, Eigen::RowMajor> A, B;
  block.evaluate(a.data(), b.data(), residuals.data(), A.data(), B.data());
  const double step = 1e-6;
  for (int k = 0; k < 4; ++k) {
    const UprightMotion d = step * UprightMotion::Unit(k);
    const auto at = [&](const UprightMotion& x, const UprightMotion& y) {
      Eigen::Vector4d r;
      block.evaluate(x.data(), y.data(), r.data(), nullptr, nullptr);
      return r;
    };
    EXPECT_LT(((at(a + d, b) - at(a - d, b)) / (2 * step) - A.col(k)).norm(), 1e-7) << k;
    EXPECT_LT(((at(a, b + d) - at(a, b - d)) / (2 * step) - B.col(k)).norm(), 1e-7) << k;
  }
}

TEST(PairBlock, YawTermIsTheFrobeniusNormOfTheTurn) {
  const PairBlock block{{0.1, 0, 0}, {1.0, Eigen::Vector3d::Zero()}};
  const UprightMotion a(0.5, 0, 0, 0), b(0.2, 0, 0, 0);
  Eigen::Vector4d r;
  block.evaluate(a.data(), b.data(), r.data(), nullptr, nullptr);
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
  R.topLeftCorner<2, 2>() = Eigen::Rotation2Dd(0.3).toRotationMatrix();
  EXPECT_NEAR(r.squaredNorm(), (R - Eigen::Matrix3d::Identity()).squaredNorm(), 1e-12);
}

TEST(PairBlock, CostsNothingWhenBothMoveAsOneBody) {
  const Eigen::Vector3d centre_a(1, 0, 0.3), centre_b(1.4, 0.2, 0.1);
  const PairBlock block{centre_a - centre_b, {1.0, Eigen::Vector3d::Ones()}};
  const double turn = 0.3;
  const Eigen::Matrix3d R = Eigen::AngleAxisd(turn, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  const Eigen::Vector3d shift(0.2, -0.1, 0.05);
  UprightMotion a, b;
  a << turn, R * centre_a + shift - centre_a;
  b << turn, R * centre_b + shift - centre_b;
  Eigen::Vector4d r;
  block.evaluate(a.data(), b.data(), r.data(), nullptr, nullptr);
  EXPECT_LT(r.norm(), 1e-12);
}

/// A cube's corner, seen as three faces' points.
BrickBlock cornerAt(const Eigen::Vector3d& centre, const Eigen::Isometry3d& moved) {
  BrickBlock block;
  block.centre = centre;
  for (int k = 0; k < 3; ++k)
    for (int i = -3; i <= 3; ++i)
      for (int j = -3; j <= 3; ++j) {
        Eigen::Vector3d d = 0.1 * Eigen::Vector3d::Unit(k);
        d[(k + 1) % 3] = 0.03 * i;
        d[(k + 2) % 3] = 0.03 * j;
        const Eigen::Vector3d p = centre + d;
        block.correspondences.push_back(
            {p, moved * p, moved.linear() * Eigen::Vector3d::Unit(k), 1.0});
      }
  return block;
}

TEST(SolveBricks, FindsTheMotionOfEachBrick) {
  std::vector<BrickBlock> blocks;
  std::vector<UprightMotion> truth, motions(3, UprightMotion::Zero());
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector3d centre(i, 0.5 * i, 0.1);
    UprightMotion motion(0.05 * (i - 1), 0.02 * i, -0.01, 0.004);
    Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
    X.linear() = Eigen::AngleAxisd(motion[0], Eigen::Vector3d::UnitZ()).toRotationMatrix();
    X.translation() = centre + motion.tail<3>() - X.linear() * centre;
    blocks.push_back(cornerAt(centre, X));
    truth.push_back(motion);
  }
  const SolveSummary summary = solveBricks(blocks, {}, motions, {});
  EXPECT_TRUE(summary.converged);
  EXPECT_LT(summary.final_cost, 1e-10);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_LT((motions[i] - truth[i]).norm(), 1e-4) << i;
}

TEST(SolveBricks, AnUnseenBrickGoesWithTheOneThatItTouches) {
  Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
  X.translation() = Eigen::Vector3d(0.03, -0.02, 0.01);
  std::vector<BrickBlock> blocks{cornerAt({0, 0, 0.1}, X), BrickBlock{}};
  const std::vector<BrickPair> pairs{{0, 1, {{0, 0, -0.2}, {0.01, {0.01, 0.01, 0.1}}}}};
  std::vector<UprightMotion> motions(2, UprightMotion::Zero());
  (void)solveBricks(blocks, pairs, motions, {});
  EXPECT_LT((motions[1] - motions[0]).norm(), 1e-4);
  EXPECT_NEAR(motions[1][1], 0.03, 1e-4);
}

TEST(BrickCovariances, KnowWhatNoFaceHolds) {
  BrickBlock block = cornerAt({0, 0, 0.1}, Eigen::Isometry3d::Identity());
  std::erase_if(block.correspondences, [](const Correspondence& c) { return c.n.x() > 0.5; });
  const std::vector<UprightMotion> motions(1, UprightMotion::Zero());
  const Eigen::Vector4d prior(0.1, 0.08, 0.08, 0.08);
  const Eigen::Matrix4d C = brickCovariances({&block, 1}, {}, motions, 0.05, prior, prior)[0];
  EXPECT_GT(std::sqrt(C(1, 1)), 0.07);  // along X only the prior holds it
  EXPECT_LT(std::sqrt(C(2, 2)), 0.01);  // 49 points of 5 cm: 7 mm
  EXPECT_LT(std::sqrt(C(3, 3)), 0.01);
}

}  // namespace
}  // namespace kiln
