#include "robot/perception/cloud/undistort.h"

#include <algorithm>
#include <array>

namespace kiln {
namespace {

constexpr std::size_t kInstants = 64;

float durationOf(const PointCloud& scan) {
  if (scan.size() == 0) return 0.0f;
  return *std::max_element(scan.time_offset_s.begin(), scan.time_offset_s.end());
}

}  // namespace

PointCloud undistort(const PointCloud& scan, const PoseTrack& X_target_lidar,
                     const std::string& target) {
  PointCloud out = scan;
  out.frame = target;
  const float duration = durationOf(scan);
  std::array<Eigen::Matrix<float, 3, 4>, kInstants + 1> poses;
  for (std::size_t i = 0; i <= kInstants; ++i) {
    const double t = static_cast<double>(duration) * static_cast<double>(i) / kInstants;
    poses[i] = X_target_lidar.at(scan.stamp + fromSeconds(t)).matrix().topRows<3>().cast<float>();
  }
  const float per_s = duration > 0 ? static_cast<float>(kInstants) / duration : 0.0f;
  for (std::size_t i = 0; i < scan.size(); ++i) {
    const float instant =
        std::clamp(scan.time_offset_s[i] * per_s, 0.0f, static_cast<float>(kInstants));
    const auto before = std::min(static_cast<std::size_t>(instant), kInstants - 1);
    const float share = instant - static_cast<float>(before);
    const Eigen::Vector4f p_lidar(scan.x[i], scan.y[i], scan.z[i], 1.0f);
    // Mixing the two images is mixing the poses, but for a chord of 1.6 ms of turning.
    const Eigen::Vector3f p =
        (1.0f - share) * (poses[before] * p_lidar) + share * (poses[before + 1] * p_lidar);
    out.x[i] = p.x();
    out.y[i] = p.y();
    out.z[i] = p.z();
  }
  return out;
}

PoseTrack lidarInBase(const PointCloud& scan, const RobotGeometry& geometry, const ArmTrack& arm) {
  constexpr int kSamples = 16;
  PoseTrack out;
  if (arm.empty()) return out;
  const float duration = durationOf(scan);
  const Eigen::Isometry3d X_flange_lidar = geometry.X_flange_lidar.pose();
  for (int i = 0; i <= kSamples; ++i) {
    const Stamp t = scan.stamp + fromSeconds(static_cast<double>(duration) * i / kSamples);
    out.push(t, geometry.X_base_flange(*arm.at(t)) * X_flange_lidar);
  }
  return out;
}

}  // namespace kiln
