#include "robot/localization/mapping/keyframe.h"

namespace kiln {

std::vector<Eigen::Vector3f> pointsInMap(const Keyframe& keyframe,
                                         const Eigen::Isometry3d& X_map_base) {
  const PointCloud& scan = keyframe.scan_base;
  const Eigen::Matrix3f R = X_map_base.linear().cast<float>();
  const Eigen::Vector3f t = X_map_base.translation().cast<float>();
  std::vector<Eigen::Vector3f> points;
  points.reserve(scan.size());
  for (std::size_t i = 0; i < scan.size(); ++i)
    points.emplace_back(R * Eigen::Vector3f(scan.x[i], scan.y[i], scan.z[i]) + t);
  return points;
}

}  // namespace kiln
