#include <cmath>

#include "tests/unit/robot/sim/brick_rig.h"

namespace kiln::sim {
namespace {

/// The arm holds still, its face looking down 0.9 m above the ground; bricks are held up to it.
class GripperTest : public testing::Test {
 protected:
  void SetUp() override {
    rig.run(0.5);
    start_z = rig.X_map_tool().translation().z();
    ASSERT_LT(rig.X_map_tool().linear()(2, 2), -0.99) << "the face looks down";
  }
  /// Flush under the face with the magnets on, then left to itself.
  void hang(std::size_t brick, double gap_m = 0.0, double off_m = 0.0) {
    rig.magnets(true);
    for (int i = 0; i < 50; ++i) {  // fields rise while it is held up
      rig.hang(brick, gap_m, off_m);
      rig.step();
    }
    rig.run(1.5);
  }
  [[nodiscard]] bool hangs(std::size_t brick) {
    return rig.height(brick) > start_z - 0.5 * kBrickSide_m - 0.02;
  }

  BrickRig rig;
  double start_z = 0.0;
};

TEST_F(GripperTest, EightFlushHoldEachKind) {
  for (const BrickKind kind : {BrickKind::Red, BrickKind::Green, BrickKind::Blue}) {
    const std::size_t brick = rig.first(kind);
    hang(brick);
    EXPECT_TRUE(hangs(brick)) << rig.arena.wall.bricks[brick].name;
    EXPECT_EQ(rig.bricks().grip().held, brick);
    EXPECT_NEAR(rig.bricks().grip().touch.pull(), 85.0, 1.0);
    rig.magnets(false);
    rig.run(1.0);
    EXPECT_FALSE(hangs(brick)) << "let go";
    EXPECT_FALSE(rig.bricks().grip().held.has_value());
    rig.bricks().place(brick, Eigen::Isometry3d(Eigen::Translation3d(8, 5, 0.1)));
  }
}

TEST_F(GripperTest, NothingIsHeldWithoutTheMagnets) {
  const std::size_t brick = rig.first(BrickKind::Red);
  rig.hang(brick, 0.0);
  rig.run(1.0);
  EXPECT_FALSE(hangs(brick));
}

/// 1 mm away all eight pull with about 3 N, less than a red brick weighs.
TEST_F(GripperTest, AGapOfAMillimetreDropsIt) {
  const std::size_t brick = rig.first(BrickKind::Red);
  hang(brick, 0.001);
  EXPECT_FALSE(hangs(brick));
}

/// 0.2 mm away they still pull more than it weighs: it snaps to the face.
TEST_F(GripperTest, AcrossAHairItSnapsToTheFace) {
  const std::size_t brick = rig.first(BrickKind::Red);
  hang(brick, 0.0002);
  EXPECT_TRUE(hangs(brick));
  EXPECT_EQ(rig.bricks().grip().held, brick);
}

/// Beside the plate there is no steel: a red one's reaches 10 cm to each side.
TEST_F(GripperTest, BesideThePlateNothingHolds) {
  const std::size_t brick = rig.first(BrickKind::Green);
  hang(brick, 0.0, 0.26);
  EXPECT_FALSE(hangs(brick));
}

TEST_F(GripperTest, TheForceSensorFeelsThePayload) {
  const auto weight = [this] {
    double sum = 0.0;
    for (int i = 0; i < 100; ++i) {
      rig.step();
      sum -= rig.arm->report(rig.now, *rig.physics).wrench_tool[2];
    }
    return sum / 100;
  };
  const double head = weight();
  const std::size_t brick = rig.first(BrickKind::Green);
  hang(brick);
  ASSERT_TRUE(hangs(brick));
  EXPECT_NEAR(weight() - head, 1.5 * 9.81, 0.3);
  EXPECT_EQ(rig.arm->setPayload({rig.arena.robot.head_kg + 1.5,
                                 (rig.arena.robot.head_kg * Eigen::Vector3d(0, 0, 0.09) +
                                  1.5 * Eigen::Vector3d(0, 0.22, 0.09)) /
                                     (rig.arena.robot.head_kg + 1.5)}),
            "");
  rig.run(0.5);
  EXPECT_NEAR(weight(), 0.0, 0.3) << "told of head and brick, it feels neither";
}

TEST_F(GripperTest, KeepsItsBrickWhenTheLinkIsLostAndDropsItWithoutPower) {
  const std::size_t brick = rig.first(BrickKind::Green);
  hang(brick);
  rig.run(3.0);  // nobody writes
  EXPECT_TRUE(hangs(brick));
  rig.gripper->setPowered(false);
  rig.run(1.0);
  EXPECT_FALSE(hangs(brick));
  rig.gripper->setPowered(true);
  EXPECT_TRUE(rig.gripper->report(rig.now, false).on.none()) << "they stay off when it comes back";
}

TEST_F(GripperTest, ABrokenMagnetTakesNoCurrent) {
  rig.gripper->setBroken(2, true);
  rig.magnets(true);
  rig.run(0.1);
  const GripperState state = rig.gripper->report(rig.now, false);
  EXPECT_TRUE(state.on.all());
  EXPECT_LT(state.current_a[2], 0.1);
  EXPECT_GT(state.current_a[3], 0.3);
}

/// Turned by a quarter, the plate hangs by shear alone. 1 kg is half of what holds.
TEST_F(GripperTest, ShearHoldsOneKilogram) {
  const std::size_t brick = rig.first(BrickKind::Red);
  hang(brick);
  Vector6d side = rig.q;
  side[5] -= 0.5 * M_PI;
  rig.moveTo(side, 4.0);
  EXPECT_LT(std::fabs(rig.X_map_tool().linear()(2, 2)), 0.01);
  rig.run(1.0);
  EXPECT_EQ(rig.bricks().grip().held, brick);
}

/// The same by a quarter turn of the middle of the load: as far as the rule says, not farther. What
/// does not hold slips along the face before it falls.
TEST_F(GripperTest, ShearBeyondTheRuleSlips) {
  BrickRig weak([] {
    WorldConfig config = BrickRig::quiet();
    config.wall.magnets.shear_n = 8.0;  // a red brick weighs 9.8 N
    return config;
  }());
  weak.run(0.5);
  const std::size_t brick = weak.first(BrickKind::Red);
  weak.magnets(true);
  for (int i = 0; i < 50; ++i) {
    weak.hang(brick, 0.0);
    weak.step();
  }
  weak.run(1.0);
  ASSERT_EQ(weak.bricks().grip().held, brick);
  Vector6d side = weak.q;
  side[5] -= 0.5 * M_PI;
  weak.moveTo(side, 4.0);
  weak.run(2.0);
  EXPECT_NE(weak.bricks().grip().held, brick);
  EXPECT_LT(weak.height(brick), weak.X_map_tool().translation().z() - 0.05) << "it slid down";
}

/// The way of a real grasp: down onto the brick until the switch closes, magnets, up again.
TEST_F(GripperTest, PicksABrickFromTheGround) {
  const std::size_t brick = rig.first(BrickKind::Red);
  const Eigen::Isometry3d X_base_map = rig.physics->X_map_base().inverse();
  Eigen::Isometry3d X_map_brick = rig.X_map_tool();
  X_map_brick.linear() =
      X_map_brick.linear() * Eigen::AngleAxisd(M_PI, Eigen::Vector3d::UnitX()).toRotationMatrix();
  X_map_brick.translation() += Eigen::Vector3d(0.15, 0.01, 0);
  X_map_brick.translation().z() = 0.1;
  rig.bricks().place(brick, X_map_brick);
  rig.run(0.3);
  const auto over = [&](double above_m) {
    Eigen::Isometry3d X = rig.X_map_tool();
    X.translation() = X_map_brick.translation() + Eigen::Vector3d(0.01, 0.0, 0.1 + above_m);
    return rig.reach(X_base_map * X);
  };
  rig.moveTo(over(0.05), 3.0);
  EXPECT_FALSE(rig.bricks().grip().touched.has_value());
  rig.moveTo(over(-0.0015), 2.0);
  EXPECT_EQ(rig.bricks().grip().touched, brick) << "the switch is pressed";
  rig.magnets(true);
  rig.run(0.3);
  rig.moveTo(over(0.3), 3.0);
  EXPECT_EQ(rig.bricks().grip().held, brick);
  EXPECT_NEAR(rig.height(brick), 0.4, 0.01);
  EXPECT_TRUE(rig.collisions.collisions().empty())
      << rig.collisions.collisions().front().a << " " << rig.collisions.collisions().front().b;
  rig.moveTo(over(0.0003), 3.0);  // a guarded motion would end at the ground
  rig.magnets(false);
  rig.run(0.3);
  rig.moveTo(over(0.2), 3.0);
  EXPECT_NEAR(rig.height(brick), 0.1, 0.002) << "set down";
  EXPECT_TRUE(rig.collisions.collisions().empty())
      << rig.collisions.collisions().front().a << " " << rig.collisions.collisions().front().b
      << " " << rig.collisions.collisions().front().force_n << " N: a placement is no collision";
}

}  // namespace
}  // namespace kiln::sim
