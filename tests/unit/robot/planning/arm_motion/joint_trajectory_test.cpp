#include "robot/planning/arm_motion/joint_trajectory.h"

#include <cmath>

#include <gtest/gtest.h>

namespace kiln {
namespace {

struct Worst {
  double speed = 0.0, accel = 0.0, jerk = 0.0, qd_error = 0.0;
};

/// Largest derivatives by finite differences of q, and the error of the reported qd.
Worst differentiate(const JointTrajectory& trajectory, double dt = 0.004) {
  Worst worst;
  Vector6d q[4];
  int n = 0;
  for (double t = 0.0; t <= trajectory.duration() + 0.1; t += dt, ++n) {
    for (int i = 3; i > 0; --i) q[i] = q[i - 1];
    const auto point = trajectory.at(t);
    q[0] = point.q;
    if (n < 3) continue;
    const Vector6d v = (q[0] - q[1]) / dt, v1 = (q[1] - q[2]) / dt, v2 = (q[2] - q[3]) / dt;
    worst.speed = std::max(worst.speed, v.cwiseAbs().maxCoeff());
    worst.accel = std::max(worst.accel, ((v - v1) / dt).cwiseAbs().maxCoeff());
    worst.jerk = std::max(worst.jerk, ((v - 2 * v1 + v2) / (dt * dt)).cwiseAbs().maxCoeff());
    const Vector6d middle = trajectory.at(t - 0.5 * dt).qd;
    worst.qd_error = std::max(worst.qd_error, (v - middle).cwiseAbs().maxCoeff());
  }
  return worst;
}

JointPathLimits limits() {
  JointPathLimits l;
  l.speed << 0.6, 0.6, 0.9, 0.9, 0.9, 0.9;
  l.accel = Vector6d::Constant(2.0);
  l.jerk_time_s = 0.12;
  return l;
}

TEST(JointTrajectory, StraightMoveIsSynchronousAndKeepsSpeedAccelerationAndJerk) {
  Vector6d a = Vector6d::Zero(), b;
  b << 1.0, -0.5, 2.0, 0.1, 0.0, -0.7;
  const JointTrajectory trajectory({straightJointPath(a, b)}, limits());
  EXPECT_EQ((trajectory.at(0.0).q - a).norm(), 0.0);
  EXPECT_LT((trajectory.at(trajectory.duration()).q - b).norm(), 1e-12);
  for (double t = 0.1; t < trajectory.duration(); t += 0.1) {
    const Vector6d q = trajectory.at(t).q;
    ASSERT_LT((q - b * (q[2] / b[2])).norm(), 1e-9) << "on the straight line";
  }
  const Worst worst = differentiate(trajectory);
  EXPECT_LE(worst.speed, 0.9 + 1e-6);
  EXPECT_LE(worst.accel, 2.0 + 1e-3);
  EXPECT_LE(worst.jerk, 2.0 * 2.0 / 0.12 * 1.05);
  EXPECT_LT(worst.qd_error, 1e-3);
  // Elbow leads: 2 rad at 0.9 rad/s and 60 % of 2 rad/s2: v / a + d / v + window = 0.75 + 2.22 +
  // 0.12 s.
  EXPECT_NEAR(trajectory.duration(), 3.09, 0.05);
}

TEST(JointTrajectory, ShortMovesNeverReachTheSpeedLimit) {
  Vector6d b = Vector6d::Zero();
  b[1] = 0.05;
  const JointTrajectory trajectory({straightJointPath(Vector6d::Zero(), b)}, limits());
  const Worst worst = differentiate(trajectory);
  EXPECT_LT(worst.speed, 0.3);
  EXPECT_LE(worst.accel, 2.0);
  EXPECT_NEAR(trajectory.at(100.0).q[1], 0.05, 1e-12);
}

TEST(JointTrajectory, NoWayTakesNoTime) {
  const Vector6d q = Vector6d::Constant(0.3);
  const JointTrajectory trajectory({straightJointPath(q, q)}, limits());
  EXPECT_EQ(trajectory.duration(), 0.0);
  EXPECT_EQ((trajectory.at(0.0).q - q).norm(), 0.0);
  EXPECT_TRUE(trajectory.at(1.0).qd.isZero());
}

TEST(JointTrajectory, RestsBetweenTwoPaths) {
  Vector6d a = Vector6d::Zero(), b = Vector6d::Zero(), c = Vector6d::Zero();
  b[0] = 0.8;
  c[1] = 0.8;
  const JointTrajectory trajectory({straightJointPath(a, b), straightJointPath(b, c)}, limits());
  double slowest = INFINITY;
  for (double t = 0.3 * trajectory.duration(); t < 0.7 * trajectory.duration(); t += 0.002) {
    slowest = std::min(slowest, trajectory.at(t).qd.norm());
  }
  EXPECT_LT(slowest, 0.01);
  EXPECT_LE(differentiate(trajectory).accel, 2.0 + 1e-3);
  EXPECT_LT((trajectory.goal() - c).norm(), 1e-12);
}

TEST(JointTrajectory, SlowsDownWhereTheJointsMustMoveMuch) {
  // A path coordinate in metres whose joint slope has a peak in the middle, as near a singularity.
  JointPath path;
  for (int k = 0; k <= 200; ++k) {
    const double s = k / 200.0;
    path.s.push_back(s);
    Vector6d q = Vector6d::Zero();
    q[3] = std::atan((s - 0.5) * 20.0);  // slope 20 rad/m at s = 0.5
    path.q.push_back(q);
  }
  JointPathLimits l = limits();
  l.path_speed = 0.25;
  l.path_accel = 0.5;
  const JointTrajectory trajectory({path}, l);
  const Worst worst = differentiate(trajectory);
  EXPECT_LE(worst.speed, 0.9 * 1.02);
  EXPECT_LE(worst.accel, 2.0 * 1.3);  // the averaging window spreads the bend a little
}

TEST(SlowedTo, LastsAsLongAsWantedAndKeepsItsSmoothness) {
  Vector6d b = Vector6d::Zero();
  b[3] = 0.45;
  const JointPath path = straightJointPath(Vector6d::Zero(), b);
  for (const double wanted : {1.5, 4.2, 12.0}) {
    const JointTrajectory slow({path}, slowedTo(path, limits(), wanted));
    EXPECT_NEAR(slow.duration(), wanted, 1e-3);
    EXPECT_LT((slow.at(wanted).q - b).norm(), 1e-9);
    EXPECT_LT(differentiate(slow).accel, 2.0);
  }
  const JointTrajectory fastest({path}, limits());
  const JointTrajectory sooner({path}, slowedTo(path, limits(), 0.1));
  EXPECT_EQ(sooner.duration(), fastest.duration()) << "no faster than the limits";
  // A path without length has nothing to slow down.
  const JointPath none = straightJointPath(b, b);
  EXPECT_LT(JointTrajectory({none}, slowedTo(none, limits(), 4.0)).duration(), 0.2);
}

}  // namespace
}  // namespace kiln
