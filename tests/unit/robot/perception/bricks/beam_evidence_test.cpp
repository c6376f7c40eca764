#include "robot/perception/bricks/beam_evidence.h"

#include <random>

#include <gtest/gtest.h>

#include "common/geom/pose.h"
#include "robot/scene/raycaster.h"

namespace kiln {
namespace {

const Eigen::Vector3d kSensor{0.0, 0.0, 1.4};

/// Beams on a raster of 0.2 deg towards what stands 3 m ahead, with range noise.
std::vector<Beam> beamsAt(std::span<const ModelBrick> bricks) {
  Raycaster rays;
  rays.addBox({40, 40, 1}, makePose({0, 0, -0.5}, {0, 0, 0}), 0);
  for (const ModelBrick& brick : bricks) rays.addBox(brickSize(brick.kind), brick.X_world_brick, 1);
  rays.commit();
  std::vector<Raycaster::Ray> queries;
  for (int i = -60; i <= 60; ++i)
    for (int j = 0; j <= 120; ++j) {
      const double azimuth = 0.0035 * i, elevation = -0.15 - 0.0035 * j;
      queries.push_back(
          {kSensor.cast<float>(),
           Eigen::Vector3d(std::cos(elevation) * std::cos(azimuth),
                           std::cos(elevation) * std::sin(azimuth), std::sin(elevation))
               .cast<float>(),
           100.0F, 1});
    }
  std::vector<Raycaster::Hit> hits(queries.size());
  rays.cast(queries, hits);
  std::mt19937 random(5);
  std::normal_distribution<float> noise(0.0F, 0.012F);
  std::vector<Beam> out;
  for (std::size_t i = 0; i < hits.size(); ++i)
    if (hits[i].valid())
      out.push_back({queries[i].origin,
                     queries[i].origin + (hits[i].range + noise(random)) * queries[i].direction});
  return out;
}

ModelBrick brickAt(double x, double y) {
  return {0, BrickKind::Red, makePose({x, y, 0.1}, {0, 0, M_PI_2})};  // its length across the view
}

std::array<FaceGrid, 6> latticeOf(const ModelBrick& brick) {
  ModelWorld world;
  world.bricks = {brick};
  world.sensors = {kSensor};
  return ModelCloudGenerator({}).generate(world).lattice[0];
}

TEST(Outline, PullsABrickSidewaysToWhereItsEdgesAre) {
  const std::vector<ModelBrick> truth{brickAt(3.0, 0.0)};
  const std::vector<Beam> beams = beamsAt(truth);
  const BeamIndex index(beams, kSensor, {3.0, 0.0, 0.1});
  const ModelBrick believed = brickAt(3.0, 0.03);  // 3 cm to the left
  const auto edges = outline(index, believed, index.near(believed, 0.1), kSensor, BeamGates{});
  double sum = 0.0;
  int sideways = 0;
  for (const Correspondence& c : edges) {
    if (std::abs(c.n.y()) < 0.9) continue;
    sum += (c.q - c.p).y();
    ++sideways;
  }
  ASSERT_GE(sideways, 2);
  EXPECT_NEAR(sum / sideways, -0.03, 0.004);
}

TEST(Outline, HasNoEdgeWhereANeighbourGoesOn) {
  const std::vector<ModelBrick> truth{brickAt(3.0, 0.0), brickAt(3.0, 0.302), brickAt(3.0, -0.302)};
  const std::vector<Beam> beams = beamsAt(truth);
  const BeamIndex index(beams, kSensor, {3.0, 0.0, 0.1});
  for (const Correspondence& c :
       outline(index, truth[0], index.near(truth[0], 0.1), kSensor, BeamGates{}))
    EXPECT_LT(std::abs(c.n.y()), 0.1);
}

TEST(Weigh, FindsABrickThatIsThere) {
  const std::vector<ModelBrick> truth{brickAt(3.0, 0.0)};
  const std::vector<Beam> beams = beamsAt(truth);
  const BeamIndex index(beams, kSensor, {3.0, 0.0, 0.1});
  const SurfaceEvidence e =
      weigh(index, truth[0], latticeOf(truth[0]), index.near(truth[0], 0.02), BeamGates{});
  EXPECT_EQ(e.expected, 300);  // 15 x 10 cells in front and as many above
  EXPECT_GT(e.found, 225);
  EXPECT_LT(e.empty, 10);
}

TEST(Weigh, SeesThroughABrickThatIsNot) {
  const std::vector<Beam> beams = beamsAt({});
  const BeamIndex index(beams, kSensor, {3.0, 0.0, 0.1});
  const ModelBrick ghost = brickAt(3.0, 0.0);
  const SurfaceEvidence e =
      weigh(index, ghost, latticeOf(ghost), index.near(ghost, 0.02), BeamGates{});
  // The lowest rows lie within the gates of the ground behind them.
  EXPECT_GT(e.empty, e.expected / 2);
  EXPECT_LT(e.found, e.expected / 3);
}

TEST(Weigh, TellsHiddenFromEmpty) {
  const ModelBrick wanted = brickAt(3.0, 0.0), before = brickAt(2.72, 0.0);
  const std::vector<Beam> beams = beamsAt(std::vector<ModelBrick>{wanted, before});
  const BeamIndex index(beams, kSensor, {3.0, 0.0, 0.1});
  const SurfaceEvidence e =
      weigh(index, wanted, latticeOf(wanted), index.near(wanted, 0.02), BeamGates{});
  EXPECT_GT(e.hidden, 10);
  EXPECT_LT(e.empty, 10);
}

}  // namespace
}  // namespace kiln
