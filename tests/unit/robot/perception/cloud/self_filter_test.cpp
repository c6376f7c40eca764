#include "robot/perception/cloud/self_filter.h"

#include <random>

#include <gtest/gtest.h>

#include "common/config/resources.h"

namespace kiln {
namespace {

Stamp at(double s) { return Stamp{fromSeconds(s)}; }

RobotGeometry bob() {
  RobotGeometry geometry;
  const auto path = resourcePath("robot_model/bob.yaml");
  EXPECT_TRUE(path.has_value());
  EXPECT_TRUE(loadConfig(*path, geometry).has_value());
  return geometry;
}

/// A cloud in `lidar` from points in base.
PointCloud fromBase(const RobotGeometry& geometry, const Vector6d& q,
                    const std::vector<Eigen::Vector3d>& p_base, float dt = 0.0f) {
  const Eigen::Isometry3d X_lidar_base =
      (geometry.X_base_flange(q) * geometry.X_flange_lidar.pose()).inverse();
  PointCloud cloud;
  cloud.frame = "lidar";
  for (const auto& p : p_base) {
    const Eigen::Vector3f l = (X_lidar_base * p).cast<float>();
    cloud.push(l.x(), l.y(), l.z(), 7, 3, dt);
  }
  return cloud;
}

TEST(SelfFilter, RemovesTheBodyInEveryArmPoseAndNothingElse) {
  const RobotGeometry geometry = bob();
  const SelfFilter filter(geometry, {});
  std::mt19937 random(11);
  std::uniform_real_distribution<double> angle(-2.5, 2.5);
  for (int trial = 0; trial < 20; ++trial) {
    Vector6d q;
    for (int i = 0; i < 6; ++i) q[i] = angle(random);
    ArmTrack arm;
    arm.push(at(0), q);
    std::vector<Eigen::Vector3d> own;
    for (const BoxConfig& box : geometry.body) {
      const Eigen::Vector3d size(box.size_m[0], box.size_m[1], box.size_m[2]);
      own.push_back(box.center.pose() *
                    Eigen::Vector3d(0.5 * size.x(), 0.3 * size.y(), -0.4 * size.z()));
    }
    const auto joints = geometry.arm.frames(q);
    for (const auto& X : joints) own.push_back(geometry.X_base_armbase.pose() * X.translation());
    for (std::size_t i = 1; i < 3;
         ++i) {  // half way along upper arm and forearm, which run sideways of their joints' line
      const Eigen::Vector3d corner = joints[i - 1] * Eigen::Vector3d(0, 0, geometry.arm.d[i]);
      own.push_back(geometry.X_base_armbase.pose() * (0.5 * (corner + joints[i].translation())));
    }
    const auto mine = filter.filter(fromBase(geometry, q, own), arm);
    EXPECT_EQ(mine.removed, own.size()) << trial;

    std::vector<Eigen::Vector3d> others;
    for (int i = 0; i < 200; ++i) {
      const double bearing = 0.0314 * i;
      others.emplace_back(3.0 * std::cos(bearing), 3.0 * std::sin(bearing), 0.4 + 0.01 * i);
    }
    const auto world = filter.filter(fromBase(geometry, q, others), arm);
    EXPECT_EQ(world.removed, 0u) << trial;
    EXPECT_EQ(world.cloud.size(), others.size());
  }
}

/// The rows of a storage and what stands in them, at both ends of their travel; what is beside them
/// stays.
TEST(SelfFilter, TakesTheStorageOutWhereverItStands) {
  RobotGeometry geometry;
  ASSERT_TRUE(loadConfig(*resourcePath("robot_model/mario.yaml"), geometry).has_value());
  ASSERT_EQ(geometry.storage.size(), 1u);
  const CompartmentConfig& row = geometry.storage.front();
  const SelfFilter filter(geometry, {});
  const Vector6d q = RobotGeometry::radians(geometry.q_drive_deg);
  ArmTrack arm;
  arm.push(at(0), q);
  std::vector<Eigen::Vector3d> own;
  for (const double position : {row.travel_min_m, 0.0, row.travel_max_m}) {
    const Eigen::Isometry3d X = row.X_base_compartment(position);
    for (const CompartmentBox& box : row.boxes())
      own.push_back(X * box.X_compartment_box * Eigen::Vector3d(0, 0, 0.5 * box.size_m.z()));
    own.push_back(X * Eigen::Vector3d(0.1, row.binY(4), 1.8));  // the top of a long one
  }
  EXPECT_EQ(filter.filter(fromBase(geometry, q, own), arm).removed, own.size());
  const std::vector<Eigen::Vector3d> others{
      {-1.5, 0, 1.0}, {-0.3, 1.1, 1.0}, {1.5, 0.5, 0.8}, {-0.3, 0.6, 0.3}};
  EXPECT_EQ(filter.filter(fromBase(geometry, q, others), arm).removed, 0u);
}

TEST(SelfFilter, PlacesTheArmWhereItWasAtEachPoint) {
  const RobotGeometry geometry = bob();
  Vector6d q0 = RobotGeometry::radians(geometry.q_drive_deg), q1 = q0;
  q1[0] += 1.0;  // shoulder pan, one radian in 0.1 s
  ArmTrack arm;
  arm.push(at(0), q0);
  arm.push(at(0.1), q1);
  // The deck, seen by the moving head at the end of the scan; the head was elsewhere at its start.
  const Eigen::Vector3d deck(-0.5, 0.6, 0.60);
  PointCloud scan = fromBase(geometry, q1, {deck}, 0.1f);
  scan.push(50, 0, 0, 1, 1, 0.0f);  // far away, at the start
  const SelfFilter filter(geometry, {.margin_m = 0.03, .slices = 50});
  EXPECT_EQ(filter.filter(scan, arm).removed, 1u);
  // With the arm believed to stand still the same measurement is taken for something beside the
  // deck.
  ArmTrack still;
  still.push(at(0), q0);
  EXPECT_EQ(filter.filter(scan, still).removed, 0u);
}

TEST(SelfFilter, DropsNaNAndSurvivesEmptyInput) {
  const SelfFilter filter(bob(), {});
  PointCloud scan;
  EXPECT_EQ(filter.filter(scan, ArmTrack{}).cloud.size(), 0u);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  scan.push(nan, 0, 0, 0, 0, 0);
  scan.push(5, 5, 1, 0, 0, 0.05f);
  const auto out = filter.filter(scan, ArmTrack{});
  EXPECT_EQ(out.invalid, 1u);
  EXPECT_EQ(out.cloud.size(), 1u);
}

}  // namespace
}  // namespace kiln
