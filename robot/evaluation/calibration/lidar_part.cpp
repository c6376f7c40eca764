#include "robot/evaluation/calibration/lidar_part.h"

#include "common/core/units.h"
#include "robot/perception/cloud/self_filter.h"

namespace kiln {
namespace {

Result<StillScan> scanHere(CalibrationRig& rig) {
  const auto q = rig.joints();
  if (!q) return tl::make_unexpected(q.error());
  const auto scan = rig.nextScan();
  if (!scan) return tl::make_unexpected(scan.error());
  ArmTrack still;
  still.push((*scan)->stamp, *q);
  auto filtered = SelfFilter(rig.nominal(), {}).filter(**scan, still);
  return StillScan{std::make_shared<PointCloud>(std::move(filtered.cloud)),
                   rig.nominal().X_base_flange(*q)};
}

}  // namespace

Result<std::vector<StillScan>> collectScans(CalibrationRig& rig, int postures,
                                            const std::function<void()>& also) {
  const Eigen::Isometry3d X_drive =
      rig.nominal().X_base_flange(RobotGeometry::radians(rig.nominal().q_drive_deg));
  const auto posture = [&](int i) {
    Eigen::Isometry3d X = X_drive;
    X.translation() +=
        Eigen::Vector3d(0.25 + spread(i, 2, 0.3), spread(i, 3, 0.35), 0.05 + spread(i, 5, 0.25));
    X.rotate(Eigen::AngleAxisd(spread(i, 7, 100.0 * kDeg), Eigen::Vector3d::UnitY()) *
             Eigen::AngleAxisd(spread(i, 11, 45.0 * kDeg), Eigen::Vector3d::UnitX()) *
             Eigen::AngleAxisd(spread(i, 13, 60.0 * kDeg), Eigen::Vector3d::UnitZ()));
    return X;
  };
  std::vector<StillScan> out;
  const auto visited = rig.visit(rig.reachable(0, postures, posture), [&]() -> Result<void> {
    auto seen = scanHere(rig);
    if (!seen) return tl::make_unexpected(seen.error());
    out.push_back(std::move(*seen));
    also();
    return {};
  });
  if (!visited) return tl::make_unexpected(visited.error());
  return out;
}

}  // namespace kiln
