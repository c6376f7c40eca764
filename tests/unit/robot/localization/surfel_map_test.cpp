#include "robot/localization/surfel_map.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "robot/localization/surfel_map_file.h"
#include "tests/unit/robot/localization/synthetic_map.h"

namespace kiln {
namespace {

const Eigen::Vector3d kInside{10.0, 0.0, 0.8};

/// A wall in the plane x = `x`, 4 m wide and 2 m high, with 5 mm of noise.
std::vector<Eigen::Vector3f> wallAt(double x, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> noise(0.0, 0.005);
  std::vector<Eigen::Vector3f> points;
  for (double y = -2.0; y < 2.0; y += 0.02) {
    for (double z = 0.05; z < 2.0; z += 0.04)
      points.push_back(Eigen::Vector3d(x + noise(random), y, z).cast<float>());
  }
  return points;
}

double pointsSeen(const SurfelMap& map) {
  double sum = 0.0;
  for (int level = 0; level < map.config().levels; ++level) {
    for (const auto& cell : map.ownCells(level)) sum += cell.sides[0].count + cell.sides[1].count;
  }
  return sum;
}

TEST(SurfelMap, HoldsAWallAsPlanesOfEveryLevelThatFaceTheSensor) {
  SurfelMap map({}, {0, 0, 0.8});
  map.insert(wallAt(2.05, 1), {0, 0, 1});
  map.refresh();
  for (int level = 0; level < map.config().levels; ++level) {
    const auto surfels = map.surfels(level);
    ASSERT_FALSE(surfels.empty()) << "level " << level;
    for (const Surfel& surfel : surfels) {
      EXPECT_LT(surfel.normal.x(), -0.99F) << "level " << level;
      EXPECT_NEAR(surfel.mean.x(), 2.05F, 0.01F);
    }
  }
}

TEST(SurfelMap, KeepsTheTwoSidesOfAThinWallApart) {
  SurfelMap map({}, {0, 0, 0.8});
  map.insert(wallAt(2.02, 1), {0, 0, 1});  // 6 cm thick: both faces in one cell of 0.1 m
  map.insert(wallAt(2.08, 2), {4, 0, 1});
  map.refresh();
  SurfelMap::Neighbours near;
  map.gather(0, {2.05F, 0.33F, 1.0F}, {-1, 0, 0}, near);
  ASSERT_GT(near.size, 0);
  for (int i = 0; i < near.size; ++i) EXPECT_NEAR(near.surfels[i]->mean.x(), 2.02F, 0.01F);
  map.gather(0, {2.05F, 0.33F, 1.0F}, {1, 0, 0}, near);
  ASSERT_GT(near.size, 0);
  for (int i = 0; i < near.size; ++i) EXPECT_NEAR(near.surfels[i]->mean.x(), 2.08F, 0.01F);
}

TEST(SurfelMap, TakesAScanOutAgainExactly) {
  SurfelMap map({}, {0, 0, 0.8});
  map.insert(wallAt(2.0, 1), {0, 0, 1});
  map.refresh();
  const auto before = map.surfels(0);
  const auto scan = map.insert(wallAt(2.03, 2), {0, 1, 1});
  map.insert({}, {0, 0, 1});
  map.refresh();
  ASSERT_TRUE(map.remove(scan).has_value());
  map.refresh();
  const auto after = map.surfels(0);
  ASSERT_EQ(before.size(), after.size());
  for (std::size_t i = 0; i < before.size(); ++i) {
    EXPECT_NEAR((before[i].mean - after[i].mean).norm(), 0.0F, 1e-6F);
    EXPECT_NEAR((before[i].normal - after[i].normal).norm(), 0.0F, 1e-4F);
  }
  EXPECT_EQ(map.remove(scan).error().code, ErrorCode::NotFound) << "taken out already";
}

TEST(SurfelMap, PutsPointsIntoTheFinestLevelThatReachesThem) {
  SurfelMap map({}, {0, 0, 0.8});  // reaches 6.4, 12.8, 25.6 and 51.2 m
  const std::vector<Eigen::Vector3f> points{{5, 0, 1},  {10, 0, 1}, {20, 0, 1},
                                            {40, 0, 1}, {60, 0, 1}, {NAN, 0, 0}};
  map.insert(points, {0, 0, 1});
  map.refresh();
  for (int level = 0; level < 4; ++level) EXPECT_EQ(map.ownCells(level).size(), 1U) << level;
  EXPECT_DOUBLE_EQ(pointsSeen(map), 4.0);
  EXPECT_DOUBLE_EQ(map.points(), 4.0) << "the coarsest level sums them all";
}

class MapFileTest : public ::testing::Test {
 protected:
  const std::vector<testing::MapScan> scans_ =
      testing::mapScans({{7.4, 0, 0}, {8.6, 1.6, 0.5}, {9.0, -1.0, -0.5}});
  const LocalizationMap map_{"kitchen",
                             {{"indoor", testing::mapOf(scans_, kInside)},
                              {"outdoor", testing::mapOf(scans_, {3, 0, 0.8})}}};
};

TEST_F(MapFileTest, GivesBackTheSamePlanesAndTheSameBytes) {
  const std::string bytes = encodeMap(map_);
  EXPECT_EQ(bytes, encodeMap(map_));
  const auto read = decodeMap(bytes, "test");
  ASSERT_TRUE(read.has_value()) << read.error();
  EXPECT_EQ(read->arena, "kitchen");
  ASSERT_NE(read->find("indoor"), nullptr);
  EXPECT_EQ(read->find("attic"), nullptr);
  EXPECT_EQ(read->find("outdoor")->center(), map_.find("outdoor")->center());
  const auto before = map_.find("indoor")->surfels(0), after = read->find("indoor")->surfels(0);
  EXPECT_NEAR(static_cast<double>(after.size()), static_cast<double>(before.size()),
              0.06 * static_cast<double>(before.size()))
      << "thin cells are left out";
  SurfelMap::Neighbours near;
  int compared = 0;
  for (const Surfel& surfel : before) {  // the file sorts the cells
    read->find("indoor")->gather(0, surfel.mean, surfel.normal, near);
    for (int i = 0; i < near.size; ++i) {
      if ((near.surfels[i]->mean - surfel.mean).norm() > 0.001F) continue;
      compared += near.surfels[i]->normal.dot(surfel.normal) > 0.99F ? 1 : 0;
      break;
    }
  }
  EXPECT_GT(compared, static_cast<int>(0.8 * static_cast<double>(before.size())));
}

TEST_F(MapFileTest, RefusesForeignCutOffAndChangedFiles) {
  const std::string bytes = encodeMap(map_);
  EXPECT_EQ(decodeMap("", "x").error().code, ErrorCode::InvalidInput);
  EXPECT_EQ(decodeMap("\x89PNG\r\n\x1a\n and more", "x").error().code, ErrorCode::InvalidInput);
  for (std::size_t size = 8; size < bytes.size(); size += 1 + bytes.size() / 37)
    EXPECT_EQ(decodeMap(bytes.substr(0, size), "x").error().code, ErrorCode::Truncated) << size;
  std::string changed = bytes;
  changed[bytes.size() / 2] = static_cast<char>(changed[bytes.size() / 2] ^ 1);
  EXPECT_EQ(decodeMap(changed, "x").error().code, ErrorCode::Truncated);
  changed = bytes;
  changed[8] = 7;
  EXPECT_EQ(decodeMap(changed, "x").error().code, ErrorCode::VersionMismatch);
  EXPECT_EQ(decodeMap(bytes + "x", "x").error().code, ErrorCode::Truncated);
  EXPECT_EQ(loadMap("/nowhere/kitchen.map").error().code, ErrorCode::NotFound);
}

}  // namespace
}  // namespace kiln
