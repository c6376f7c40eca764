#pragma once

#include <string>
#include <vector>

#include "common/config/config_archive.h"
#include "common/wire/fire/place_check.h"
#include "robot/perception/cloud/face_model.h"
#include "robot/perception/cloud/scan_window.h"

namespace kiln {

/// Where does the fire box stand, and is that where it was configured? Fits the opaque frame, the
/// rim of the opening and the table to the points of several scans: coarse search over the ground
/// plane on a likelihood grid, then Gauss-Newton with a Cauchy kernel on the faces that the LiDAR
/// can see (x, y, yaw, and a height that absorbs the tilt of base and extrinsics).
/// Thread-compatible; const calls are thread-safe. Cost: tests/bench/cloud_bench.
class BoxLocator {
 public:
  struct Config {
    double search_m = 0.45;  ///< each side of the configured place
    double search_deg = 12.0;
    double search_step_m = 0.05, search_step_deg = 4.0;
    double voxel_m = 0.02;  ///< thinning, a scan
    int max_points = 4000;
    int min_points = 80;         ///< on frame and table; fewer: unseen
    double min_coverage = 0.25;  ///< of the box's visible front bars; less: unseen
    double coarse_gate_m = 0.10, fine_gate_m = 0.035;
    double noise_m = 0.015;  ///< one sigma of a point, pose of the base included
    double height_sigma_m = 0.02;
    /// Normal scatter (scenario.md section 3: +-10 cm, +-5 deg): beyond it the place is refused.
    double max_axis_m = 0.125;    ///< along either axis of map
    double max_offset_m = 0.145;  ///< as a distance
    double max_yaw_deg = 8.5;
    FireBoxSizes sizes;  ///< set from the site's map, not from the file
    void visit(ConfigArchive& a);
  };
  explicit BoxLocator(Config config);

  /// @param X_map_front  configured pose of the place's front (PlaceCheck says which frame).
  /// @return verdict, with the sensed pose unless it is Unseen.
  [[nodiscard]] PlaceCheck check(const std::string& place, const Eigen::Isometry3d& X_map_front,
                                 const std::deque<ScanWindow::Entry>& scans) const;
  [[nodiscard]] const Config& config() const { return config_; }

 private:
  struct Sample {
    Eigen::Vector3d p;         ///< in the configured front frame
    Eigen::Vector3d p_sensor;  ///< LiDAR centre, same frame
  };
  struct Fit {
    Eigen::Vector4d x =
        Eigen::Vector4d::Zero();  ///< x, y, yaw, z of the front in the configured front
    Eigen::Matrix4d information = Eigen::Matrix4d::Zero();
    int inliers = 0;
  };
  struct Pull {
    Eigen::Matrix4d H = Eigen::Matrix4d::Zero();
    Eigen::Vector4d g = Eigen::Vector4d::Zero();
    int inliers = 0;
  };
  [[nodiscard]] Pull pullAt(const std::vector<Sample>& samples, const Eigen::Vector4d& x,
                            double gate_m) const;
  [[nodiscard]] std::vector<Sample> gather(const Eigen::Isometry3d& X_map_front,
                                           const std::deque<ScanWindow::Entry>& scans) const;
  [[nodiscard]] float likelihood(const Eigen::Vector3d& p) const;
  [[nodiscard]] Eigen::Vector3d search(const std::vector<Sample>& samples) const;
  [[nodiscard]] Fit refine(const std::vector<Sample>& samples, const Eigen::Vector3d& start) const;
  [[nodiscard]] double coverage(const std::vector<Sample>& samples, const Eigen::Vector4d& x) const;
  void judge(PlaceCheck& check) const;
  void fillGrid();

  Config config_;
  std::vector<Face> faces_;
  Eigen::Vector3d grid_low_;
  Eigen::Vector3i grid_size_;
  std::vector<float> grid_;  ///< likelihood of a point, x fastest
};

}  // namespace kiln
