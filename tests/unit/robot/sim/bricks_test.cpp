#include <cmath>

#include "robot/sim/world.h"
#include "tests/unit/robot/sim/brick_rig.h"

namespace kiln::sim {
namespace {

WorldConfig shipped(const char* name) {
  return *WorldConfig::load(*resourcePath(std::string("worlds/") + name + ".yaml"));
}

/// How far bricks have gone from there, at most.
double farthest(const std::vector<BrickTruth>& from, const std::vector<BrickTruth>& to) {
  double most = 0.0;
  for (std::size_t i = 0; i < from.size(); ++i)
    most = std::max(most,
                    (from[i].X_map_brick.translation() - to[i].X_map_brick.translation()).norm());
  return most;
}

/// All 45 bricks awake, and with freezing: the drawn piles stand where they were drawn.
TEST(Bricks, APileStandsForTwentySeconds) {
  for (const bool freeze : {false, true}) {
    WorldConfig config = shipped("wall");
    config.wall.freeze = freeze;
    auto world = std::move(*World::create(config, 5));
    (void)world->advance(world->now() + fromSeconds(1.0));
    const auto before = world->truth().wall.bricks;
    (void)world->advance(world->now() + fromSeconds(20.0));
    const WallTruth after = world->truth().wall;
    EXPECT_LT(farthest(before, after.bricks), 0.001) << "freeze " << freeze;
    EXPECT_EQ(after.falls, 0);
    EXPECT_EQ(after.score.placed, 0U);
    EXPECT_TRUE(world->truth().collisions.empty());
    EXPECT_EQ(world->awakeBricks(), freeze ? 0U : 45U);
  }
}

TEST(Bricks, ABrickThatIsPutOverTheEdgeFallsAndIsCounted) {
  BrickRig rig;
  rig.run(1.0);
  const std::size_t top = 3;  // of the red stack
  Eigen::Isometry3d X = rig.bricks().state(top).X_map_brick;
  X.translate(Eigen::Vector3d(0, 0.12, 0));  // its middle is beyond the edge of the one below
  rig.bricks().place(top, X);
  rig.run(2.0);
  EXPECT_LT(rig.height(top), 0.3);
  EXPECT_NEAR(rig.height(2), 0.5, 0.01) << "the others stand";
}

/// A forearm that sweeps through a stack knocks it over: a collision, a fall, and frozen bricks
/// wake in time.
TEST(Bricks, ACarelessArmKnocksABrickOverAndItIsCounted) {
  BrickRig rig;
  rig.run(1.5);
  EXPECT_LT(rig.bricks().awake(), 4U) << "far from the robot they are frozen";
  // A stack of four beside the head, a little lower than it.
  const Eigen::Isometry3d X_tool = rig.X_map_tool();
  const std::size_t red = rig.first(BrickKind::Red);
  for (std::size_t i = 0; i < 4; ++i)
    rig.bricks().place(red + i,
                       Eigen::Isometry3d(Eigen::Translation3d(X_tool.translation().x() - 0.06,
                                                              X_tool.translation().y() + 0.25,
                                                              0.1 + 0.2 * static_cast<double>(i))));
  rig.run(1.0);
  ASSERT_NEAR(rig.height(red + 3), 0.7, 0.01);
  Vector6d swept =
      rig.reach(rig.physics->X_map_base().inverse() * (Eigen::Translation3d(0, 0, -0.3) * X_tool));
  rig.moveTo(swept, 2.0);
  ASSERT_TRUE(rig.collisions.collisions().empty());
  swept[0] += 1.2;
  rig.moveTo(swept, 3.0);
  rig.run(1.5);
  ASSERT_FALSE(rig.collisions.collisions().empty());
  EXPECT_NE(rig.collisions.collisions().front().b.find("brick red"), std::string::npos);
  EXPECT_LT(rig.height(red + 3), 0.65);
}

/// Freezing is for speed alone: the LiDAR of a robot that turns its head sees the same.
TEST(Bricks, FreezingDoesNotChangeWhatTheLidarSees) {
  std::vector<PointCloudPtr> scans[2];
  std::size_t awake[2] = {};
  for (const int freeze : {0, 1}) {
    WorldConfig config = shipped("wall_lab");
    config.wall.freeze = freeze == 1;
    auto world = std::move(*World::create(config, 2));
    (void)world->advance(world->now() + fromSeconds(1.0));
    WorldCommands commands;
    commands.sensors = SensorRequest{.lidar = true};
    world->command(commands);
    for (int i = 0; i < 10; ++i)
      for (const PointCloudPtr& scan : world->advance(world->now() + fromSeconds(0.1)).lidar)
        scans[freeze].push_back(scan);
    awake[freeze] = world->awakeBricks();
  }
  EXPECT_EQ(awake[0], 11U);
  EXPECT_LT(awake[1], 11U);
  ASSERT_EQ(scans[0].size(), scans[1].size());
  ASSERT_GE(scans[0].size(), 5U);
  for (std::size_t k = 0; k < scans[0].size(); ++k) {
    const PointCloud &a = *scans[0][k], &b = *scans[1][k];
    ASSERT_EQ(a.size(), b.size());
    std::size_t differ = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
      differ +=
          std::fabs(a.x[i] - b.x[i]) + std::fabs(a.y[i] - b.y[i]) + std::fabs(a.z[i] - b.z[i]) >
          0.001F;
    EXPECT_LE(differ, a.size() / 1000) << "scan " << k << " of " << a.size();
  }
}

TEST(Bricks, SameSeedSameWorld) {
  std::vector<BrickTruth> bricks[2];
  for (auto& out : bricks) {
    auto world = std::move(*World::create(shipped("wall_lab"), 7));
    (void)world->advance(world->now() + fromSeconds(1.0));
    out = world->truth().wall.bricks;
  }
  for (std::size_t i = 0; i < bricks[0].size(); ++i)
    EXPECT_EQ(bricks[0][i].X_map_brick.matrix(), bricks[1][i].X_map_brick.matrix());
}

/// People carry the robot back: bricks stay, what it has stored comes along.
TEST(Bricks, AResetCarriesWhatIsStored) {
  BrickRig rig;
  rig.run(1.0);
  const CompartmentConfig& row = rig.robot.storage.front();
  const std::size_t red = rig.first(BrickKind::Red), blue = rig.first(BrickKind::Blue);
  Eigen::Isometry3d X_row_brick = Eigen::Isometry3d::Identity();
  X_row_brick.linear() =
      Eigen::AngleAxisd(-0.5 * M_PI, Eigen::Vector3d::UnitY()).toRotationMatrix();
  X_row_brick.translation() = Eigen::Vector3d(0.1, row.binY(2), 0.152);
  rig.bricks().place(red, rig.physics->X_map_base() * row.X_base_compartment(0.0) * X_row_brick);
  rig.run(1.0);
  const Eigen::Isometry3d X_base_red =
      rig.physics->X_map_base().inverse() * rig.bricks().state(red).X_map_brick;
  const Eigen::Isometry3d X_map_blue = rig.bricks().state(blue).X_map_brick;
  rig.physics->carryTo(rig.arena.ground.standing({-2, 1, 1.0}, rig.robot), rig.q);
  rig.run(0.5);
  EXPECT_LT(
      ((rig.physics->X_map_base().inverse() * rig.bricks().state(red).X_map_brick).translation() -
       X_base_red.translation())
          .norm(),
      0.01);
  EXPECT_LT((rig.bricks().state(blue).X_map_brick.translation() - X_map_blue.translation()).norm(),
            0.001);
}

}  // namespace
}  // namespace kiln::sim
