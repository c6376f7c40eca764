#include "robot/planning/arm_motion/swept_volume.h"

#include <cmath>

#include <gtest/gtest.h>

#include "common/core/units.h"
#include "tests/unit/robot/planning/arm_motion/bob.h"

namespace kiln {
namespace {

/// A ball of points.
std::vector<Eigen::Vector3f> ball(const Eigen::Vector3d& centre, double radius = 0.06) {
  std::vector<Eigen::Vector3f> out;
  for (int i = 0; i < 40; ++i) {
    const double z = 1.0 - 2.0 * (i + 0.5) / 40, r = std::sqrt(1.0 - z * z);
    out.push_back(
        (centre + radius * Eigen::Vector3d(r * std::cos(2.4 * i), r * std::sin(2.4 * i), z))
            .cast<float>());
  }
  return out;
}

struct SweptVolume : ::testing::Test {
  RobotGeometry robot = loadBob();
  ArmCollision arm{robot};
  Vector6d q_from = RobotGeometry::radians(robot.q_drive_deg), q_to = q_from;
  std::vector<JointPath> path() { return {straightJointPath(q_from, q_to)}; }
  [[nodiscard]] Eigen::Vector3d flangeAt(double share) const {
    return robot.X_base_flange(q_from + share * (q_to - q_from)).translation();
  }
};

TEST_F(SweptVolume, FindsWhatStandsHalfWayAndSaysWhere) {
  q_to[0] += 70 * kDeg;
  const PointGrid points(ball(flangeAt(0.5)));
  const auto hit = firstInSweptVolume(arm, path(), points, {});
  ASSERT_TRUE(hit.has_value());
  EXPECT_LT(hit->path_share, 0.5) << "before the flange itself is there";
  EXPECT_GT(hit->path_share, 0.05);
  EXPECT_LT((hit->p_base - flangeAt(0.5)).norm(), 0.15);
  EXPECT_FALSE(hit->part.empty());
}

TEST_F(SweptVolume, EndsOfThePathAreLookedAtToo) {
  q_to[0] += 70 * kDeg;
  EXPECT_TRUE(firstInSweptVolume(arm, path(), PointGrid(ball(flangeAt(1.0))), {}).has_value());
  // What the arm already touches is its own: hose and mixed pixels.
  EXPECT_FALSE(
      firstInSweptVolume(arm, path(), PointGrid(ball(flangeAt(0.0), 0.02)), {}).has_value());
}

TEST_F(SweptVolume, FreeWaysAndNoiseAreFree) {
  q_to[0] += 70 * kDeg;
  EXPECT_FALSE(firstInSweptVolume(arm, path(), PointGrid({}), {}).has_value());
  EXPECT_FALSE(firstInSweptVolume(arm, {}, PointGrid(ball({2, 0, 1})), {}).has_value());
  Eigen::Vector3d beside = flangeAt(0.5);
  beside.z() += 0.8;
  EXPECT_FALSE(firstInSweptVolume(arm, path(), PointGrid(ball(beside)), {}).has_value());
  auto few = ball(flangeAt(0.5));
  few.resize(3);
  few.push_back(Eigen::Vector3f::Constant(NAN));
  EXPECT_FALSE(firstInSweptVolume(arm, path(), PointGrid(few), {}).has_value()) << "three points";
}

TEST_F(SweptVolume, NeverMissesWhatABruteForceWalkFinds) {
  std::srand(7);
  int hits = 0;
  for (int run = 0; run < 60; ++run) {
    q_to = q_from + 0.9 * Vector6d::Random();
    const Eigen::Vector3d at = flangeAt(0.3 + 0.01 * run) + 0.25 * Eigen::Vector3d::Random();
    const PointGrid points(ball(at));
    const auto found = firstInSweptVolume(arm, path(), points, {});
    bool touched = false, touched_at_start = false;
    for (int i = 0; i <= 400; ++i) {
      const ArmShapes shapes = arm.shapesAt(q_from + i / 400.0 * (q_to - q_from));
      int inside = 0;
      for (std::size_t k = 0; k < points.size(); ++k) {
        const Eigen::Vector3d p = points[k].cast<double>();
        bool in = false;
        for (std::size_t link = 1; link < 6; ++link)
          in |= distance(Capsule{p, p, 0.0}, shapes.links[link]) < 0.0;
        for (const OrientedBox& part : shapes.head)
          in |= signedDistance(part.X_frame_box.inverse() * p, part.half) < 0.0;
        inside += in ? 1 : 0;
      }
      touched |= inside >= 8;
      touched_at_start |= i == 0 && inside > 0;
    }
    hits += touched ? 1 : 0;
    if (touched && !touched_at_start) {
      EXPECT_TRUE(found.has_value()) << run;
    }
  }
  EXPECT_GT(hits, 10);
}

}  // namespace
}  // namespace kiln
