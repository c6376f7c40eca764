#include "robot/localization/mapping/pose_graph.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace kiln {
namespace {

constexpr int kNodes = 40;

Eigen::Isometry3d onCircle(int i) {
  const double a = 2.0 * M_PI * i / kNodes;
  return makePose({4 * std::cos(a), 4 * std::sin(a), 0.1 * std::sin(a)}, {0.02, -0.03, a});
}

Eigen::Matrix<double, 6, 6> sigmas(double metres, double radians) {
  Eigen::Matrix<double, 6, 6> out = Eigen::Matrix<double, 6, 6>::Zero();
  out.diagonal() << metres, metres, metres, radians, radians, radians;
  return out * out;
}

/// Steps that all turn 0.5 deg too far, chained.
struct Circle {
  std::vector<Eigen::Isometry3d> chained{onCircle(0)};
  std::vector<PoseEdge> edges;
  Circle() {
    for (int i = 1; i < kNodes; ++i) {
      const Eigen::Isometry3d step =
          onCircle(i - 1).inverse() * onCircle(i) * makePose({0, 0, 0}, {0, 0, 0.009});
      chained.push_back(chained.back() * step);
      edges.push_back({i - 1, i, EdgeKind::Odometry, step, sigmas(0.02, 0.01)});
    }
  }
  void close(int from, int to, const Eigen::Isometry3d& X) {
    edges.push_back({from, to, EdgeKind::Loop, X, sigmas(0.01, 0.003)});
  }
};

double worst(const std::vector<Eigen::Isometry3d>& poses) {
  double worst_m = 0.0;
  for (int i = 0; i < kNodes; ++i) {
    worst_m = std::max(
        worst_m,
        (poses[static_cast<std::size_t>(i)].translation() - onCircle(i).translation()).norm());
  }
  return worst_m;
}

TEST(PoseGraph, SpreadsTheDriftOverALoop) {
  Circle circle;
  const double before = worst(circle.chained);
  EXPECT_GT(before, 0.5);
  circle.close(0, kNodes - 1, onCircle(0).inverse() * onCircle(kNodes - 1));
  circle.close(0, kNodes / 2, onCircle(0).inverse() * onCircle(kNodes / 2));
  const auto solved = solvePoseGraph(circle.chained, circle.edges);
  ASSERT_TRUE(solved.has_value()) << solved.error();
  EXPECT_LT(worst(solved->poses), 0.15 * before);
  EXPECT_LT(solved->final_cost, solved->initial_cost);
  EXPECT_TRUE(solved->poses[0].isApprox(onCircle(0))) << "the first one holds the frame";
  EXPECT_LT(residualOf(solved->poses, circle.edges, EdgeKind::Loop).worst_m, 0.05);
}

TEST(PoseGraph, IsNotBentByOneFalseLoop) {
  Circle circle;
  circle.close(0, kNodes - 1, onCircle(0).inverse() * onCircle(kNodes - 1));
  circle.close(0, kNodes / 2, onCircle(0).inverse() * onCircle(kNodes / 2));
  const auto right = solvePoseGraph(circle.chained, circle.edges);
  circle.close(3, 27, Eigen::Isometry3d::Identity());  // "the same place"
  const auto solved = solvePoseGraph(circle.chained, circle.edges);
  ASSERT_TRUE(right.has_value() && solved.has_value());
  EXPECT_LT(worst(solved->poses), worst(right->poses) + 0.15);
}

TEST(PoseGraph, RefusesEdgesThatCannotBe) {
  const std::vector<Eigen::Isometry3d> nodes(2, Eigen::Isometry3d::Identity());
  const auto refused = [&](const PoseEdge& edge) {
    const auto solved = solvePoseGraph(nodes, {edge});
    return !solved && solved.error().code == ErrorCode::InvalidInput;
  };
  EXPECT_TRUE(refused({0, 2, EdgeKind::Odometry, {}, sigmas(1, 1)}));
  EXPECT_TRUE(refused({1, 1, EdgeKind::Odometry, Eigen::Isometry3d::Identity(), sigmas(1, 1)}));
  EXPECT_TRUE(refused({0, 1, EdgeKind::Odometry, Eigen::Isometry3d::Identity(), sigmas(0, 1)}));
  Eigen::Isometry3d nan = Eigen::Isometry3d::Identity();
  nan.translation().x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(refused({0, 1, EdgeKind::Odometry, nan, sigmas(1, 1)}));
}

}  // namespace
}  // namespace kiln
