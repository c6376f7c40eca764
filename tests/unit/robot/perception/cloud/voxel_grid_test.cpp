#include "robot/perception/cloud/voxel_grid.h"

#include <map>
#include <random>
#include <tuple>

#include <gtest/gtest.h>

namespace kiln {
namespace {

TEST(VoxelGrid, EqualsTheSlowWay) {
  std::mt19937 random(5);
  std::uniform_real_distribution<float> place(-3.0f, 3.0f);
  PointCloud cloud;
  std::map<std::tuple<int, int, int>, std::pair<Eigen::Vector3d, int>> slow;
  for (int i = 0; i < 5000; ++i) {
    const Eigen::Vector3f p(place(random), place(random), place(random));
    cloud.push(p.x(), p.y(), p.z(), 0, 0, 0);
    auto& [sum, n] = slow[{static_cast<int>(std::floor(p.x() / 0.5f)),
                           static_cast<int>(std::floor(p.y() / 0.5f)),
                           static_cast<int>(std::floor(p.z() / 0.5f))}];
    if (n == 0) sum.setZero();
    sum += p.cast<double>();
    ++n;
  }
  const PointCloud down = voxelDownsample(cloud, 0.5);
  ASSERT_EQ(down.size(), slow.size());
  for (std::size_t i = 0; i < down.size(); ++i) {
    const auto it = slow.find({static_cast<int>(std::floor(down.x[i] / 0.5f)),
                               static_cast<int>(std::floor(down.y[i] / 0.5f)),
                               static_cast<int>(std::floor(down.z[i] / 0.5f))});
    ASSERT_NE(it, slow.end());
    const Eigen::Vector3d mean = it->second.first / it->second.second;
    EXPECT_NEAR((Eigen::Vector3d(down.x[i], down.y[i], down.z[i]) - mean).norm(), 0.0, 1e-5);
  }
}

TEST(VoxelGrid, DropsWhatHasNoPlace) {
  PointCloud cloud;
  cloud.push(std::numeric_limits<float>::quiet_NaN(), 0, 0, 0, 0, 0);
  cloud.push(0, std::numeric_limits<float>::infinity(), 0, 0, 0, 0);
  cloud.push(1e9f, 0, 0, 0, 0, 0);
  cloud.push(1, 1, 1, 4, 5, 0.02f);
  const PointCloud down = voxelDownsample(cloud, 0.1);
  ASSERT_EQ(down.size(), 1u);
  EXPECT_EQ(down.intensity[0], 4);
  EXPECT_EQ(down.ring[0], 5);
}

}  // namespace
}  // namespace kiln
