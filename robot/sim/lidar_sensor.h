#pragma once

#include <array>
#include <vector>

#include "common/model/sensor.h"
#include "robot/sim/random.h"
#include "robot/sim/ray_scene.h"

namespace kiln::sim {

/// VLP-16: 16 lasers, one column each 55.6 us, a scan a revolution. Turns clockwise seen from
/// above, begins at the rear. Each column is cast from where the sensor was at that time. Confined
/// to one thread.
class LidarSensor {
 public:
  LidarSensor(const LidarConfig& config, const RobotGeometry& robot, const TrueRobot& truth,
              std::uint64_t seed);

  /// Casts the columns fired in (before, after]; `scene` shows the bodies in between. Returns a
  /// scan when a revolution that was seen from its start has ended.
  [[nodiscard]] PointCloudPtr advance(const SceneState& before, const SceneState& after,
                                      const RayScene& scene);
  void restart() { running_ = false; }

 private:
  struct Beam {
    float cos_elevation, sin_elevation;
    float azimuth_offset_rad;  ///< the head turns on while the 16 lasers fire one after the other
    float time_offset_s;
    int ring;
  };
  [[nodiscard]] Stamp columnTime(std::int64_t column) const;
  void fireColumn(std::int64_t column, const Eigen::Isometry3d& X_map_lidar);
  void castColumns(const RayScene& scene);
  void mixEdges(const RayScene& scene);
  void emitPoints();
  [[nodiscard]] Eigen::Isometry3d X_map_lidar(const SceneState& state) const;
  [[nodiscard]] Eigen::Vector3f direction(std::int64_t column, const Beam& beam, float turn,
                                          float tilt) const;

  LidarConfig config_;
  RobotGeometry robot_;
  Eigen::Isometry3d X_flange_lidar_;
  Random random_;
  std::array<Beam, 16> beams_{};
  std::array<double, 16> bias_m_{};
  std::array<std::optional<std::size_t>, 16> above_{}, below_{};  ///< laser of the next ring
  std::vector<Eigen::Vector3f> table_;  ///< direction in lidar by column of a turn and laser
  std::int64_t next_column_ = 0;        ///< since world start
  bool running_ = false;
  std::uint64_t seq_ = 0;
  std::shared_ptr<PointCloud> scan_;
  // One chunk; 16 rays a column.
  std::vector<Raycaster::Ray> rays_;
  std::vector<Raycaster::Hit> hits_;
  std::vector<Raycaster::Ray> packed_rays_;  ///< rays_[order_[k]]
  std::vector<Raycaster::Hit> packed_hits_;
  std::vector<std::size_t> order_;
  std::vector<Eigen::Vector3f> directions_;  ///< in lidar
  std::vector<std::int64_t> columns_;
  std::vector<Eigen::Matrix3f> rotations_;  ///< by column
};

}  // namespace kiln::sim
