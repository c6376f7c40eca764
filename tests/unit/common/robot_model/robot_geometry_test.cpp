#include "common/robot_model/robot_geometry.h"

#include <gtest/gtest.h>

#include "common/config/resources.h"

namespace kiln {
namespace {

class BobTest : public ::testing::Test {
 protected:
  void SetUp() override {
    const auto path = resourcePath("robot_model/bob.yaml");
    ASSERT_TRUE(path.has_value()) << path.error();
    const auto loaded = loadConfig(*path, bob_);
    ASSERT_TRUE(loaded.has_value()) << loaded.error();
  }
  RobotGeometry bob_;
};

TEST_F(BobTest, HoldsItsLidarUprightWhileDriving) {
  const Eigen::Isometry3d X_base_lidar =
      bob_.X_base_flange(RobotGeometry::radians(bob_.q_drive_deg)) * bob_.X_flange_lidar.pose();
  EXPECT_GT(X_base_lidar.linear()(2, 2), 0.95) << "spin axis within 18 deg of up";
  EXPECT_GT(X_base_lidar.translation().z(), 1.0) << "clear of the deck";
}

TEST_F(BobTest, FitsThroughTheDoorWithItsArmParked) {
  const auto frames = bob_.arm.frames(RobotGeometry::radians(bob_.q_park_deg));
  for (const Eigen::Isometry3d& X_armbase_joint : frames) {
    const Eigen::Vector3d p = bob_.X_base_armbase.pose() * X_armbase_joint.translation();
    EXPECT_LT(std::abs(p.y()), 0.5 * bob_.width_m) << "no joint beside the footprint";
    EXPECT_LT(p.z(), 2.2) << "below the lintel";
    EXPECT_GT(p.z(), 0.6) << "above the deck";
  }
}

TEST_F(BobTest, NozzleThermalCameraAndHeadLookTheSameWay) {
  const Eigen::Vector3d jet = bob_.X_flange_nozzle.pose().linear().col(0);
  const Eigen::Vector3d view = bob_.X_flange_thermal.pose().linear().col(2);
  EXPECT_NEAR(jet.dot(view), 1.0, 1e-9);
  EXPECT_NEAR(bob_.X_flange_rgb.pose().linear().col(2).dot(view), 1.0, 1e-9);
}

TEST(RobotGeometry, RefusesAMisspeltKey) {
  RobotGeometry geometry;
  const auto loaded =
      loadYamlText("lenght_m: 2\n", "bob.yaml", {[&](ConfigArchive& a) { geometry.visit(a); }});
  ASSERT_FALSE(loaded.has_value());
  EXPECT_EQ(loaded.error().message, "bob.yaml:1: unknown key 'lenght_m'; did you mean 'length_m'?");
}

}  // namespace
}  // namespace kiln
