#include <cmath>

#include "tests/unit/robot/sim/brick_rig.h"

namespace kiln::sim {
namespace {

class StorageTest : public testing::Test {
 protected:
  void SetUp() override { rig.run(0.5); }
  /// Writes the target at 20 Hz for so long. @return the last report
  StorageState drive(double target_m, double seconds) {
    const std::vector<double> targets{target_m};
    for (double t = 0.0; t < seconds; t += 0.048) {
      EXPECT_EQ(rig.storage->write(rig.now, targets), "");
      rig.run(0.048);
    }
    return rig.storage->report(rig.now, *rig.physics);
  }
  /// A brick upright in a bin, a little above the floor and 1 cm before the back.
  void setIn(std::size_t brick, int bin, double above_m) {
    const CompartmentConfig& row = rig.robot.storage.front();
    const double half = 0.5 * rig.arena.wall.bricks[brick].size_m.x();
    Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
    X.linear() = Eigen::AngleAxisd(-0.5 * M_PI, Eigen::Vector3d::UnitY()).toRotationMatrix();
    X.translation() = Eigen::Vector3d(0.09, row.binY(bin), half + above_m);
    rig.bricks().place(brick, rig.physics->X_map_base() *
                                  row.X_base_compartment(rig.physics->compartment(0).position) * X);
  }
  [[nodiscard]] Eigen::Vector3d inRow(std::size_t brick) {
    const CompartmentConfig& row = rig.robot.storage.front();
    return (rig.physics->X_map_base() *
            row.X_base_compartment(rig.physics->compartment(0).position))
               .inverse() *
           rig.bricks().state(brick).X_map_brick.translation();
  }

  BrickRig rig;
};

TEST_F(StorageTest, TravelsAtSixCentimetresASecond) {
  StorageState state = drive(0.3, 2.0);
  EXPECT_NEAR(state.compartments[0].position_m, 0.06 * 2.0, 0.02);
  EXPECT_TRUE(state.compartments[0].moving);
  state = drive(0.3, 4.0);
  EXPECT_NEAR(state.compartments[0].position_m, 0.3, 0.001);
  EXPECT_FALSE(state.compartments[0].moving);
  state = drive(-0.3, 11.5);
  EXPECT_NEAR(state.compartments[0].position_m, -0.3, 0.001);
  EXPECT_FALSE(state.compartments[0].blocked);
}

TEST_F(StorageTest, StopsWhenNoTargetComesAnyMore) {
  (void)drive(0.3, 2.0);
  rig.run(0.5);
  const StorageState lost = rig.storage->report(rig.now, *rig.physics);
  EXPECT_TRUE(lost.setpoint_lost);
  EXPECT_FALSE(lost.compartments[0].moving);
  const double at = lost.compartments[0].position_m;
  rig.run(1.0);
  EXPECT_NEAR(rig.storage->report(rig.now, *rig.physics).compartments[0].position_m, at, 0.001);
  EXPECT_LT(at, 0.16) << "a quarter of a second and its braking beyond 0.12 m";
}

TEST_F(StorageTest, AJamIsNoticedByItsCurrentAndEndsWithAnotherTarget) {
  (void)drive(0.1, 1.0);
  rig.storage->setJammed(0, true);
  StorageState state = drive(0.3, 2.5);
  EXPECT_TRUE(state.compartments[0].blocked);
  EXPECT_LT(state.compartments[0].position_m, 0.1);
  state = drive(0.3, 0.5);
  EXPECT_TRUE(state.compartments[0].blocked) << "the same target is no new one";
  rig.storage->setJammed(0, false);
  state = drive(0.0, 3.0);
  EXPECT_FALSE(state.compartments[0].blocked);
  EXPECT_NEAR(state.compartments[0].position_m, 0.0, 0.001);
}

TEST_F(StorageTest, RefusesWhatIsBeyondItsTravel) {
  EXPECT_NE(rig.storage->write(rig.now, {0.4}), "");
  EXPECT_NE(rig.storage->write(rig.now, {std::nan("")}), "");
  EXPECT_NE(rig.storage->write(rig.now, {0.1, 0.1}), "");
  rig.run(0.5);
  EXPECT_NEAR(rig.physics->compartment(0).position, 0.0, 0.002);
}

/// Set in a little above the floor, bricks slide down and back against the wall, and lean there
/// while the row travels.
TEST_F(StorageTest, BricksSlideAgainstTheBackAndStayInTheirBins) {
  const std::size_t red = rig.first(BrickKind::Red), blue = rig.first(BrickKind::Blue);
  setIn(red, 1, 0.01);
  setIn(red + 1, 1, 0.32);  // on top of it
  setIn(blue, 3, 0.01);
  rig.run(2.0);
  const CompartmentConfig& row = rig.robot.storage.front();
  const auto leans = [&](std::size_t brick, int bin, double height_m) {
    const Eigen::Vector3d p = inRow(brick);
    const std::string name = rig.arena.wall.bricks[brick].name;
    EXPECT_NEAR(p.x(), row.bin_depth_m - 0.5 * kBrickSide_m, 0.004) << name;
    EXPECT_NEAR(p.y(), row.binY(bin), 0.004) << name;
    EXPECT_NEAR(p.z(), height_m, 0.005) << name;
  };
  leans(red, 1, 0.15);
  leans(red + 1, 1, 0.45);
  leans(blue, 3, 0.6);
  (void)drive(0.3, 6.0);
  leans(red, 1, 0.15);
  leans(red + 1, 1, 0.45);
  leans(blue, 3, 0.6);
  EXPECT_TRUE(rig.collisions.collisions().empty())
      << rig.collisions.collisions().front().a << " with " << rig.collisions.collisions().front().b
      << ", " << rig.collisions.collisions().front().force_n << " N";
}

}  // namespace
}  // namespace kiln::sim
