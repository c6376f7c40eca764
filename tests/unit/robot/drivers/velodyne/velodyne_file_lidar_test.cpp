#include "robot/drivers/velodyne/device/velodyne_file_lidar.h"

#include <gtest/gtest.h>

#include "common/core/manual_executor.h"
#include "tests/support/data_dir.h"

namespace kiln {
namespace {

class VelodyneFileLidarTest : public ::testing::Test {
 protected:
  void SetUp() override {
    const auto path = testing::dataFile("mrpt_velodyne/sample_velodyne_vlp16_gps.pcap");
    if (!path) GTEST_SKIP() << "no captures here: set KILN_DATA_DIR";
    auto opened = VelodyneFileLidar::open(path->string(), executor_);
    ASSERT_TRUE(opened.has_value()) << opened.error();
    lidar_ = std::move(*opened);
  }
  ManualClock clock_;
  ManualExecutor executor_{clock_};
  std::unique_ptr<VelodyneFileLidar> lidar_;
  std::vector<PointCloudPtr> clouds_;
};

TEST_F(VelodyneFileLidarTest, PlaysAtTheRecordedPaceAndBeginsAgain) {
  ASSERT_TRUE(lidar_->start([this](PointCloudPtr c) { clouds_.push_back(std::move(c)); }));
  executor_.runUntil(Stamp{std::chrono::seconds(4)});
  // 0.39 s hold two or three whole revolutions of 0.1 s: at least 5 a second with the seams left
  // out
  EXPECT_GE(clouds_.size(), 20u);
  EXPECT_LE(clouds_.size(), 40u);
  for (std::size_t i = 0; i < clouds_.size(); ++i) {
    EXPECT_GT(clouds_[i]->size(), 5000u);
    EXPECT_LE(clouds_[i]->stamp, clock_.now());
    if (i > 0) {
      EXPECT_GE(toSeconds(clouds_[i]->stamp - clouds_[i - 1]->stamp), 0.099);
    }
    if (i > 0) {
      EXPECT_EQ(clouds_[i]->seq, clouds_[i - 1]->seq + 1);
    }
  }
}

TEST_F(VelodyneFileLidarTest, StopsAndStartsAgain) {
  const auto sink = [this](PointCloudPtr c) { clouds_.push_back(std::move(c)); };
  ASSERT_TRUE(lidar_->start(sink));
  EXPECT_FALSE(lidar_->start(sink).has_value());  // already running
  executor_.runUntil(Stamp{std::chrono::seconds(1)});
  lidar_->stop();
  const std::size_t before = clouds_.size();
  executor_.runUntil(Stamp{std::chrono::seconds(2)});
  EXPECT_EQ(clouds_.size(), before);
  ASSERT_TRUE(lidar_->start(sink));
  executor_.runUntil(Stamp{std::chrono::seconds(3)});
  EXPECT_GT(clouds_.size(), before);
}

TEST_F(VelodyneFileLidarTest, TheTickMayOutliveTheDevice) {
  ASSERT_TRUE(lidar_->start([this](PointCloudPtr c) { clouds_.push_back(std::move(c)); }));
  lidar_.reset();
  executor_.runUntil(Stamp{std::chrono::seconds(1)});
  EXPECT_TRUE(clouds_.empty());
}

}  // namespace
}  // namespace kiln
