#pragma once

#include <functional>

#include "common/core/clock.h"
#include "robot/skills/surroundings.h"

namespace kiln {

/// A live cloud that a test fills; odometry from wherever the test has it. Scans come at 10 Hz
/// unless `silent`.
class TestSurroundings final : public Surroundings {
 public:
  TestSurroundings(const Clock& clock, std::function<Pose2()> odometry)
      : clock_(clock), odometry_(std::move(odometry)) {}
  [[nodiscard]] ObstacleCloudPtr obstacles() const override {
    if (!silent) {
      constexpr std::int64_t kScan_ns = 100'000'000;
      newest_ = stampFromNanoseconds(toNanoseconds(clock_.now()) / kScan_ns * kScan_ns);
    }
    auto cloud = std::make_shared<ObstacleCloud>();
    cloud->stamp = newest_;
    cloud->points = points;
    return cloud;
  }
  [[nodiscard]] Pose2 X_odom_base() const override { return odometry_(); }

  /// A post of 16 points around (x, y, z) in odom.
  void stand(double x, double y, double z) {
    for (int i = 0; i < 16; ++i)
      points.push_back({Eigen::Vector3d(x + 0.05 * std::cos(0.4 * i), y + 0.05 * std::sin(0.4 * i),
                                        z - 0.05 + 0.006 * i)
                            .cast<float>(),
                        static_cast<float>(z)});
  }
  std::vector<ObstacleCloud::Point> points;
  bool silent = false;

 private:
  const Clock& clock_;
  std::function<Pose2()> odometry_;
  mutable Stamp newest_;
};

}  // namespace kiln
