#include "robot/perception/bricks/model_cloud.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "common/geom/pose.h"
#include "robot/perception/bricks/point_tree.h"
#include "robot/scene/pile_layout.h"
#include "tests/support/quantile.h"
#include "tests/unit/robot/perception/bricks/render_cloud.h"

namespace kiln {
namespace {

using test::quantile;

std::vector<double> distances(const std::vector<ModelPoint>& from,
                              const std::vector<ModelPoint>& to) {
  std::vector<Eigen::Vector3f> points;
  for (const ModelPoint& point : to) points.push_back(point.p);
  const PointTree tree(points);
  std::vector<double> out;
  for (const ModelPoint& point : from) {
    const std::uint32_t i = tree.nearest(point.p, 1.0F);
    out.push_back(i == PointTree::kNone ? 1.0 : static_cast<double>((points[i] - point.p).norm()));
  }
  return out;
}

/// Lattices of 2 cm that do not coincide are about 8 mm apart though they are of one surface. So
/// both clouds go through the same voxel grid; ours is sampled finer before.
TEST(ModelCloud, EqualsTheRenderThinnedTheSameWay) {
  ModelWorld world = pileSeenFromAhead();
  // Line 2 lies 5.4 m away and is seen from above at 6 deg: there the render's own pixels are 5 cm
  // apart.
  std::erase_if(world.bricks, [](const ModelBrick& brick) {
    return brick.X_world_brick.translation().y() > 1.0;
  });
  ModelCloudGenerator generator({0.01, 0.05});
  const std::vector<ModelPoint> ours = voxelised(generator.generate(world).points, 0.02);
  const std::vector<ModelPoint> render = voxelised(renderCloud(world, 2800), 0.02);
  ASSERT_GT(render.size(), 5000U);
  for (const auto& d : {distances(ours, render), distances(render, ours)}) {
    EXPECT_LE(quantile(d, 0.5), 0.005);
    EXPECT_LE(quantile(d, 0.99), 0.02);
  }
}

TEST(ModelCloud, EveryPointHasTheBrickAndNormalThatTheRenderHasThere) {
  const ModelWorld world = pileSeenFromAhead();
  const std::vector<ModelPoint> ours = ModelCloudGenerator({}).generate(world).points;
  const std::vector<ModelPoint> render = renderCloud(world, 700);
  std::vector<Eigen::Vector3f> points;
  for (const ModelPoint& point : ours) points.push_back(point.p);
  const PointTree tree(points);
  int asked = 0, same = 0;
  for (const ModelPoint& pixel : render) {
    const std::uint32_t i = tree.nearest(pixel.p, 0.012F);
    if (i == PointTree::kNone) continue;
    ++asked;
    if (ours[i].brick == pixel.brick && ours[i].n.dot(pixel.n) > 0.999F) ++same;
  }
  EXPECT_GT(asked, static_cast<int>(render.size()) * 8 / 10);
  EXPECT_GT(same, asked * 93 / 100);  // along edges the nearest point may be around the corner
}

TEST(ModelCloud, HasOnlyFacesThatLookAtTheSensor) {
  ModelWorld world;
  world.bricks = {{7, BrickKind::Green, makePose({3, 0, 0.1}, {0, 0, 0})}};
  world.sensors = {{0, 0, 1.5}};
  const ModelCloud cloud = ModelCloudGenerator({}).generate(world);
  // -X and +Z alone: 10 x 10 and 30 x 10 cells.
  EXPECT_EQ(cloud.points.size(), 400U);
  EXPECT_EQ(cloud.visibleOf(0), 400);
  for (const ModelPoint& point : cloud.points) {
    EXPECT_TRUE(point.face == 0 || point.face == 5);
    EXPECT_EQ(point.brick, 0);
  }
}

TEST(ModelCloud, ABrickOnAnotherHidesTheFacesBetweenThem) {
  ModelWorld world;
  for (int layer = 0; layer < 2; ++layer)
    world.bricks.push_back({layer, BrickKind::Red, makePose({3, 0, 0.1 + 0.2 * layer}, {0, 0, 0})});
  world.sensors = {{0, 0, 1.5}};
  const ModelCloud cloud = ModelCloudGenerator({}).generate(world);
  EXPECT_EQ(cloud.visibleOf(0), 100);  // its -X face of 10 x 10 cells; the upper face is covered
  EXPECT_EQ(cloud.visibleOf(1), 250);  // -X, and +Z of 15 x 10
}

TEST(ModelCloud, GroundIsSeenWhereNoBrickStandsBeforeIt) {
  ModelWorld world;
  world.bricks = {{0, BrickKind::Red, makePose({3, 0, 0.1}, {0, 0, 0})}};
  world.ground = GroundPatch{makePose({3.5, 0, 0}, {0, 0, 0}), 0.5, 0.5};
  world.sensors = {{0, 0, 1.5}};
  const ModelCloud cloud = ModelCloudGenerator({}).generate(world);
  // The shadow ends where the ray over the far upper edge lands: 3.15 * 1.5 / 1.3 = 3.63.
  int ground = 0, in_shadow = 0;
  for (const ModelPoint& point : cloud.points) {
    if (point.brick != ModelPoint::kGround) continue;
    ++ground;
    EXPECT_NEAR(point.p.z(), 0.0, 1e-5);
    if (point.p.x() > 3.17F && point.p.x() < 3.6F && std::abs(point.p.y()) < 0.09F) ++in_shadow;
  }
  EXPECT_GT(ground, 1000);
  EXPECT_EQ(in_shadow, 0);
}

TEST(ModelCloud, KnowsTheSameBricksElsewhere) {
  ModelCloudGenerator generator({});
  ModelWorld world;
  world.bricks = {{0, BrickKind::Red, makePose({3, 0, 0.1}, {0, 0, 0})}};
  world.sensors = {{0, 0, 1.5}};
  const std::size_t before = generator.generate(world).points.size();
  world.bricks[0].X_world_brick = makePose({0, 3, 0.1}, {0, 0, M_PI_2});
  const ModelCloud cloud = generator.generate(world);
  EXPECT_EQ(cloud.points.size(), before);
  for (const ModelPoint& point : cloud.points) EXPECT_GT(point.p.y(), 2.8F);
}

}  // namespace
}  // namespace kiln
