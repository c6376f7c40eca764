// Scan preparation on a robot whose arm and base move as in teleoperation, against the simulator's
// LiDAR.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "robot/perception/cloud/range_bias.h"
#include "tests/unit/robot/perception/cloud/scan_rig.h"

namespace kiln {
namespace {

/// Full stick: three joints at the jog limit of 0.6 rad/s, base at 0.35 m/s and 0.2 rad/s.
ScanRig::Motion teleop(const RobotGeometry& robot, double t) {
  Vector6d q = RobotGeometry::radians(robot.q_drive_deg);
  q[0] += 0.6 * t;
  q[3] -= 0.3 * t;
  q[5] += 0.6 * t;
  const double yaw = 0.2 * t;
  return {{8.0 + 0.35 * std::sin(yaw) / 0.2, 0.35 * (1 - std::cos(yaw)) / 0.2, yaw}, q};
}

/// Distances of prepared points to the surfaces of the true kitchen, those of the robot left out.
std::vector<double> errorsOf(const ScanRig& rig, const PointCloud& scan, const Pose2& X_map_base) {
  std::vector<double> out;
  const Eigen::Isometry3d X = toIsometry(X_map_base);
  for (std::size_t i = 0; i < scan.size(); ++i) {
    const Eigen::Vector3d p = X * Eigen::Vector3d(scan.x[i], scan.y[i], scan.z[i]);
    double nearest = std::abs(p.z());  // the floor
    const auto offer = [&](const sim::SolidBox& box) {
      const Eigen::Vector3d d = (box.X_map_box.inverse() * p).cwiseAbs() - 0.5 * box.size_m;
      const double outside = d.cwiseMax(0.0).norm();
      nearest = std::min(nearest, outside > 0.0 ? outside : -d.maxCoeff());
    };
    for (const auto& box : rig.arena.boxes) offer(box);
    for (const auto& place : rig.arena.fire_places)
      for (const auto& box : place.boxes) offer(box);
    out.push_back(nearest);
  }
  std::sort(out.begin(), out.end());
  return out;
}

TEST(ScanPreparation, PointsAreStillAlthoughTheArmSwings) {
  ScanRig rig(1, false);
  rig.config.lidar.bias_sigma_m = 0.0;
  rig.lidar = std::make_unique<sim::LidarSensor>(rig.config.lidar, rig.robot, rig.arena.robot, 1);
  const auto motion = [&](double t) { return teleop(rig.robot, t); };
  double blind_median = 0.0;
  for (const double t : {0.4, 0.9, 1.4}) {
    const auto scan = rig.scan(t, motion);
    const Pose2 X_map_base = motion(toSeconds(scan->stamp)).X_map_base;
    const auto errors = errorsOf(rig, rig.prepare(*scan, motion), X_map_base);
    ASSERT_GT(errors.size(), 10000u);
    // Noise of 1 cm alone has a median of 0.67 cm along the beam, less across slanted surfaces.
    EXPECT_LT(errors[errors.size() / 2], 0.0075) << t;
    EXPECT_LT(errors[errors.size() * 95 / 100], 0.025) << t;
    // Without the arm's motion the same scan is smeared.
    const auto frozen = [&](double) { return motion(toSeconds(scan->stamp)); };
    const auto smeared = errorsOf(rig, rig.prepare(*scan, frozen), X_map_base);
    blind_median = smeared[smeared.size() / 2];
    EXPECT_GT(blind_median, 2.0 * errors[errors.size() / 2]) << t;
  }
}

TEST(ScanPreparation, NothingOfRobotHoseAndHeldBrickIsLeft) {
  ScanRig rig(2);
  int seen_robot = 0;
  for (const bool moving : {false, true}) {
    const auto motion = [&](double t) { return teleop(rig.robot, moving ? t : 0.3); };
    const auto scan = rig.scan(0.5, motion);
    const PointCloud prepared = rig.prepare(*scan, motion);
    seen_robot += static_cast<int>(scan->size() - prepared.size());
    // Nothing of the kitchen is nearer than 1.3 m to the middle of the base, up to 2 m high.
    for (std::size_t i = 0; i < prepared.size(); ++i) {
      const bool on_robot = std::hypot(prepared.x[i], prepared.y[i]) < 1.3 &&
                            prepared.z[i] > 0.25 && prepared.z[i] < 2.0;
      EXPECT_FALSE(on_robot) << prepared.x[i] << " " << prepared.y[i] << " " << prepared.z[i]
                             << (moving ? " moving" : " still");
    }
  }
  EXPECT_GT(seen_robot, 300) << "the LiDAR does see the robot";
}

TEST(ScanPreparation, AHeldBrickIsFilteredWhereTheToolHoldsIt) {
  const ScanRig rig(1, false);
  const BoxConfig brick{"brick", {{0.1, 0.0, 0.15}, {0, 0, 0}}, {0.2, 1.4, 0.2}};
  const Vector6d q = RobotGeometry::radians(rig.robot.q_drive_deg);
  const Eigen::Isometry3d X_lidar_tool =
      rig.robot.X_flange_lidar.pose().inverse() * rig.robot.X_flange_tool.pose();
  PointCloud scan;
  const Eigen::Vector3f on = (X_lidar_tool * Eigen::Vector3d(0.15, 0.65, 0.22)).cast<float>(),
                        beside = (X_lidar_tool * Eigen::Vector3d(0.15, 0.9, 0.9)).cast<float>();
  scan.push(on.x(), on.y(), on.z(), 30, 3, 0.0f);
  scan.push(beside.x(), beside.y(), beside.z(), 30, 3, 0.05f);
  ArmTrack arm;
  arm.push(scan.stamp, q);
  const SelfFilter filter(rig.robot, {});
  EXPECT_EQ(filter.filter(scan, arm).removed, 0u);
  const std::vector<BoxConfig> held{brick};
  const auto out = filter.filter(scan, arm, held);
  EXPECT_EQ(out.removed, 1u);
  ASSERT_EQ(out.cloud.size(), 1u);
  EXPECT_FLOAT_EQ(out.cloud.x[0], beside.x());
}

TEST(RangeBias, TakesEachLasersBiasOffAlongItsBeam) {
  PointCloud scan;
  scan.push(3, 4, 0, 0, 2, 0);
  scan.push(0, 0, 2, 0, 9, 0);
  scan.push(NAN, 0, 0, 0, 2, 0);
  const std::vector<double> bias = {0, 0, 0.5};
  correctRanges(scan, bias);
  EXPECT_NEAR(std::hypot(scan.x[0], scan.y[0]), 4.5, 1e-6);
  EXPECT_NEAR(scan.y[0] / scan.x[0], 4.0 / 3.0, 1e-6);
  EXPECT_EQ(scan.z[1], 2.0f) << "no bias known for ring 9";
  EXPECT_TRUE(std::isnan(scan.x[2]));
}

}  // namespace
}  // namespace kiln
