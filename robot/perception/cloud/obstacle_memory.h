#pragma once

#include <cstdint>
#include <unordered_map>

#include "common/model/obstacle_cloud.h"
#include "robot/perception/cloud/local_ground.h"

namespace kiln {

/// What one scan says of the obstacles around: made on the pool, applied by ObstacleMemory.
struct ObstacleScan {
  Stamp stamp;
  Eigen::Isometry3d X_base_lidar = Eigen::Isometry3d::Identity();  ///< at `stamp`
  struct Point {
    Eigen::Vector3f p_base;
    float height_m;
  };
  std::vector<Point> points;
  /// Longest return by ring and direction (0.5 deg), metres; 0 = none: what can be seen through.
  std::vector<float> range_m;
};

/// Remembers what stood around the robot, because the LiDAR is blind near the robot (its lowest
/// beam points 15 deg down): a low thing that was seen from 4 m stays known while the robot comes
/// near. Cubes in odom; one is forgotten when a beam passes through it, or when it was not seen for
/// long. Needs two scans to believe. Confined to one thread.
class ObstacleMemory {
 public:
  struct Config {
    double voxel_m = 0.1;
    double max_range_m = 6.0;    ///< from the base
    double min_height_m = 0.12;  ///< above the local ground; lower can be driven over or is noise
    double max_height_m = 2.0;   ///< higher passes over robot and folded arm
    double keep_s = 20.0;        ///< not seen for so long: odometry has drifted
    int min_scans = 2;
    int max_misses = 2;           ///< beams that pass through until it is forgotten
    double see_through_m = 0.25;  ///< a beam must end so far behind
    int max_voxels = 60000;
    LocalGround::Config ground;
    void visit(ConfigArchive& a);
  };
  explicit ObstacleMemory(Config config) : config_(config) {}
  /// Pure; for the pool. @param scan_base  prepared scan, in `base` at its stamp.
  [[nodiscard]] static ObstacleScan observe(const Config& config, const PointCloud& scan_base,
                                            const Eigen::Isometry3d& X_base_lidar);
  void add(const ObstacleScan& scan, const Pose2& X_odom_base);
  void clear();  ///< after a reset: odometry begins anew
  /// What is believed now; nullptr before the first scan.
  [[nodiscard]] ObstacleCloudPtr snapshot() const { return snapshot_; }

 private:
  struct Voxel {
    std::uint64_t key;
    Eigen::Vector3f p_odom = Eigen::Vector3f::Zero();
    float height_m = 0.0f;
    Stamp seen;
    int scans = 0, misses = 0;
  };
  [[nodiscard]] std::uint64_t keyOf(const Eigen::Vector3f& p) const;
  void insert(const ObstacleScan& scan, const Pose2& X_odom_base);
  void forget(const ObstacleScan& scan, const Pose2& X_odom_base);
  void publish(Stamp stamp);

  Config config_;
  std::vector<Voxel> voxels_;  ///< dense: all of them are looked at with each scan
  /// Neighbouring cubes have neighbouring keys, which the identity would put into one bucket.
  struct Scatter {
    std::size_t operator()(std::uint64_t key) const {
      return static_cast<std::size_t>((key * 0x9E3779B97F4A7C15ULL) >> 20);  // Knuth: golden ratio
    }
  };
  std::unordered_map<std::uint64_t, std::size_t, Scatter> slots_;  ///< key -> index in voxels_
  ObstacleCloudPtr snapshot_;
};

}  // namespace kiln
